// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// OpenGL calls of a moving frame that make the CPU wait for the graphics card, or allocate. VTK calls
// OpenGL through function pointers, which this test replaces; VTK before 9.4 has none for OpenGL 1.1.
#include "OcclusionScene.h"
#include "ShaftScene.h"

#include "vtkCamera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#if __has_include("vtk_glad.h")
#include "vtk_glad.h"

namespace
{

using Pass = vtkPenumbraTemporalSSAOPass;

/// Results that the graphics card computed at least this many frames ago are available without
/// waiting.
constexpr int FramesUntilAvailable = 2;

/// Calls since the last reset.
struct CallCounts
{
  int Waits = 0;       ///< for all commands, or for a result of the last frames
  int Results = 0;     ///< of queries that are older
  int Readbacks = 0;   ///< of textures into buffers
  int Allocations = 0; ///< of textures
};
CallCounts Calls;
int Frame = 0;
GLuint ActiveQuery = 0;
std::map<GLuint, int> QueryFrames;  ///< in which queries ended
std::map<GLuint, int> BufferFrames; ///< in which buffers received pixels

void CountWait(int since)
{
  Frame - since < FramesUntilAvailable ? ++Calls.Waits : ++Calls.Results;
}

GLuint GetPixelBuffer()
{
  GLint buffer = 0;
  glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &buffer);
  return static_cast<GLuint>(buffer);
}

void Read()
{
  const GLuint buffer = GetPixelBuffer();
  buffer > 0 ? ++Calls.Readbacks : ++Calls.Waits;
  BufferFrames[buffer] = Frame;
}

void OnFinish()
{
  ++Calls.Waits;
}

void OnBeginQuery(GLenum, GLuint query)
{
  ActiveQuery = query;
}

void OnEndQuery(GLenum)
{
  QueryFrames[ActiveQuery] = Frame;
}

void OnQueryResult(GLuint query, GLenum name, GLuint*)
{
  if (name == GL_QUERY_RESULT)
  {
    CountWait(QueryFrames[query]);
  }
}

void OnReadPixels(GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void*)
{
  Read();
}

void OnGetTexImage(GLenum, GLint, GLenum, GLenum, void*)
{
  Read();
}

void OnGetBufferSubData(GLenum, GLintptr, GLsizeiptr, void*)
{
  ++Calls.Waits;
}

void OnClientWaitSync(GLsync, GLbitfield, GLuint64)
{
  ++Calls.Waits;
}

void OnMapBuffer(GLenum target, GLenum)
{
  const auto filled = BufferFrames.find(GetPixelBuffer());
  if (target == GL_PIXEL_PACK_BUFFER && filled != BufferFrames.end() &&
    Frame - filled->second < FramesUntilAvailable)
  {
    ++Calls.Waits;
  }
}

void OnTexImage(GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void*)
{
  ++Calls.Allocations;
}

void OnTexImageMultisample(GLenum, GLsizei, GLenum, GLsizei, GLsizei, GLboolean)
{
  ++Calls.Allocations;
}

/// Replaces an OpenGL function, for the lifetime of this object, by one that calls an observer
/// first.
template <auto& Function, auto Observe, typename Pointer>
class Hook;
template <auto& Function, auto Observe, typename Result, typename... Arguments>
class Hook<Function, Observe, Result(GLAD_API_PTR*)(Arguments...)>
{
public:
  Hook()
  {
    Original = Function;
    Function = &Hook::Call;
  }
  ~Hook() { Function = Original; }
  Hook(const Hook&) = delete;
  void operator=(const Hook&) = delete;

private:
  static Result GLAD_API_PTR Call(Arguments... arguments)
  {
    Observe(arguments...);
    return Original(arguments...);
  }
  static inline Result(GLAD_API_PTR* Original)(Arguments...) = nullptr;
};

struct Hooks
{
  Hook<glFinish, OnFinish, decltype(glFinish)> Finish;
  Hook<glReadPixels, OnReadPixels, decltype(glReadPixels)> ReadPixels;
  Hook<glBeginQuery, OnBeginQuery, decltype(glBeginQuery)> BeginQuery;
  Hook<glEndQuery, OnEndQuery, decltype(glEndQuery)> EndQuery;
  Hook<glGetQueryObjectuiv, OnQueryResult, decltype(glGetQueryObjectuiv)> QueryResult;
  Hook<glGetTexImage, OnGetTexImage, decltype(glGetTexImage)> GetTexImage;
  Hook<glGetBufferSubData, OnGetBufferSubData, decltype(glGetBufferSubData)> GetBufferSubData;
  Hook<glClientWaitSync, OnClientWaitSync, decltype(glClientWaitSync)> ClientWaitSync;
  Hook<glMapBuffer, OnMapBuffer, decltype(glMapBuffer)> MapBuffer;
  Hook<glTexImage2D, OnTexImage, decltype(glTexImage2D)> TexImage;
  Hook<glTexImage2DMultisample, OnTexImageMultisample, decltype(glTexImage2DMultisample)>
    TexImageMultisample;
};

/// Renders a frame and counts its calls.
CallCounts CountFrame(vtkRenderWindow* window)
{
  const Hooks hooks;
  ++Frame;
  Calls = CallCounts();
  window->Render();
  return Calls;
}

/// Calls of 40 frames after 20 others, in addition to those of VTK.
struct MotionCounts
{
  int Waits = 0;
  int Results = 0;
  int Readbacks = 0;
  int MostAllocations = 0; ///< in one frame
};

/// Counts the calls of VTK in a frame without passes first; `addPass` adds the pass.
template <typename AddPass, typename Motion>
MotionCounts CountCalls(vtkRenderWindow* window, const AddPass& addPass, const Motion& move)
{
  window->Render(); // loads the functions of OpenGL
  const CallCounts plain = CountFrame(window);
  addPass();
  MotionCounts counts;
  for (int frame = 0; frame < 60; ++frame)
  {
    move();
    const CallCounts calls = CountFrame(window);
    if (frame >= 20)
    {
      counts.Waits += calls.Waits - plain.Waits;
      counts.Results += calls.Results;
      counts.Readbacks += calls.Readbacks;
      counts.MostAllocations =
        std::max(counts.MostAllocations, calls.Allocations - plain.Allocations);
    }
  }
  return counts;
}

/// A sphere on a floor, with ambient occlusion by the march kernel.
class MovingFrame : public testing::Test
{
protected:
  MovingFrame()
  {
    this->Scene.AddFloor();
    this->Scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0.4 });
    this->Sphere = this->Scene.AddSphere({ -0.5, 0, 0.5 }, 0.5);
  }

  template <typename Motion>
  MotionCounts Count(const Motion& move)
  {
    return CountCalls(
      this->Scene.Window,
      [this]() {
        this->Scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(Pass::NEVER);
        this->Scene.Pass->SetKernelName("march");
      },
      move);
  }

  OcclusionScene Scene;
  vtkSmartPointer<vtkActor> Sphere;
};

TEST_F(MovingFrame, DoesNotWaitOrAllocateWhileTheCameraMoves)
{
  const MotionCounts counts =
    this->Count([this]() { this->Scene.Renderer->GetActiveCamera()->Azimuth(0.25); });
  EXPECT_EQ(counts.Waits, 0);
  EXPECT_EQ(counts.MostAllocations, 0);
  // Depths, for the thickness, in one of eight frames.
  EXPECT_LE(counts.Readbacks, 5);
  EXPECT_GT(counts.Readbacks, 1); // the calls are counted
}

TEST_F(MovingFrame, DoesNotWaitWhileActorsMove)
{
  const MotionCounts counts = this->Count([this]() { this->Sphere->AddPosition(0.02, 0.0, 0.0); });
  EXPECT_EQ(counts.Waits, 0);
  EXPECT_GT(counts.Results, 1); // of comparisons of depths
  EXPECT_LE(counts.Results, 4);
  EXPECT_LE(counts.MostAllocations, 1); // one matrix per moved actor
  EXPECT_LE(counts.Readbacks, 5);
}

/// Solids in haze, with light shafts.
class MovingShafts : public testing::TestWithParam<int>
{
protected:
  MovingShafts()
    : Scene(96, 72)
  {
    this->Scene.AddFloor(12.0);
    this->Scene.AddSolids(4, 2);
    this->Sphere = this->Scene.AddSphere({ 0.0, 0.0, 2.0 }, 0.5);
    this->Scene.Look({ 0.5, -11.0, 2.5 }, { 0.0, 0.0, 2.0 });
    this->Scene.AddSun({ 0.2, 1.0, 0.32 });
  }

  /// The automatic tone reads the brightness of every frame back.
  template <typename Motion>
  MotionCounts Count(bool tone, const Motion& move)
  {
    const int estimator = this->GetParam();
    vtkPenumbraLightShaftPass::RemoveFrom(this->Scene.Renderer);
    return CountCalls(
      this->Scene.Window,
      [&]() {
        this->Scene.Pass = vtkPenumbraLightShaftPass::AddTo(this->Scene.Renderer);
        this->Scene.SetMedium(0.12, 0.12);
        this->Scene.Pass->SetEstimator(estimator);
        this->Scene.Pass->SetAutomaticTone(tone);
      },
      move);
  }

  ShaftScene Scene;
  vtkSmartPointer<vtkActor> Sphere;
};

TEST_P(MovingShafts, DoNotWaitWhileTheCameraMoves)
{
  for (const bool tone : { false, true })
  {
    const MotionCounts counts =
      this->Count(tone, [this]() { this->Scene.Renderer->GetActiveCamera()->Azimuth(0.25); });
    EXPECT_EQ(counts.Waits, 0) << tone;
    EXPECT_EQ(counts.Readbacks, tone ? 40 : 0);
    EXPECT_EQ(counts.MostAllocations, 0) << tone;
  }
}

TEST_P(MovingShafts, DoNotWaitWhileActorsMove)
{
  for (const bool tone : { false, true })
  {
    const MotionCounts counts =
      this->Count(tone, [this]() { this->Sphere->AddPosition(0.02, 0.0, 0.0); });
    EXPECT_EQ(counts.Waits, 0) << tone;
    EXPECT_EQ(counts.Readbacks, tone ? 40 : 0);
    EXPECT_EQ(counts.MostAllocations, 0) << tone;
  }
}

INSTANTIATE_TEST_SUITE_P(Estimators, MovingShafts,
  testing::Values(vtkPenumbraLightShaftPass::DEPTH, vtkPenumbraLightShaftPass::RADIAL,
    vtkPenumbraLightShaftPass::SHADOW_MAP));

}
#endif
