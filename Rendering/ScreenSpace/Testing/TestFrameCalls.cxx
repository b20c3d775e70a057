// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// OpenGL calls of a moving frame that make the CPU wait for the graphics card, or allocate. VTK calls
// OpenGL through function pointers, which this test replaces; VTK before 9.4 has none for OpenGL 1.1.
#include "OcclusionScene.h"

#include "vtkCamera.h"

#include <gtest/gtest.h>

#if __has_include("vtk_glad.h")
#include "vtk_glad.h"

namespace
{

using Pass = vtkPenumbraTemporalSSAOPass;

/// Calls since the last reset.
struct CallCounts
{
  int Waits = 0;       ///< glFinish, results of queries, reading into memory
  int Readbacks = 0;   ///< of textures into buffers
  int Maps = 0;        ///< of buffers into memory
  int Allocations = 0; ///< of textures
};
CallCounts Calls;

/// Replaces an OpenGL function, for the lifetime of this object, by one that increments a counter
/// first.
template <auto& Function, int CallCounts::*Counter, typename Pointer>
class Hook;
template <auto& Function, int CallCounts::*Counter, typename Result, typename... Arguments>
class Hook<Function, Counter, Result(GLAD_API_PTR*)(Arguments...)>
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
    ++(Calls.*Counter);
    return Original(arguments...);
  }
  static inline Result(GLAD_API_PTR* Original)(Arguments...) = nullptr;
};

struct Hooks
{
  Hook<glFinish, &CallCounts::Waits, decltype(glFinish)> Finish;
  Hook<glReadPixels, &CallCounts::Waits, decltype(glReadPixels)> ReadPixels;
  Hook<glGetQueryObjectuiv, &CallCounts::Waits, decltype(glGetQueryObjectuiv)> Query;
  Hook<glGetTexImage, &CallCounts::Readbacks, decltype(glGetTexImage)> GetTexImage;
  Hook<glMapBuffer, &CallCounts::Maps, decltype(glMapBuffer)> MapBuffer;
  Hook<glTexImage2D, &CallCounts::Allocations, decltype(glTexImage2D)> TexImage;
  Hook<glTexImage2DMultisample, &CallCounts::Allocations, decltype(glTexImage2DMultisample)>
    TexImageMultisample;
};

/// Calls of a frame without the pass: those of VTK itself.
CallCounts CountPlainFrame(OcclusionScene& scene)
{
  scene.Window->Render(); // loads the functions of OpenGL
  const Hooks hooks;
  Calls = CallCounts();
  scene.Window->Render();
  return Calls;
}

/// Renders 40 frames after 20 others. Expects at most `queries` calls that wait, and at most
/// `allocations` per frame, in addition to those of VTK.
template <typename Motion>
void ExpectNoWaits(OcclusionScene& scene, const Motion& move, int queries, int allocations)
{
  const CallCounts plain = CountPlainFrame(scene);
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(Pass::NEVER);
  scene.Pass->SetKernelName("march");
  int waits = 0;
  int readbacks = 0;
  for (int frame = 0; frame < 60; ++frame)
  {
    const Hooks hooks;
    Calls = CallCounts();
    move();
    scene.Window->Render();
    if (frame >= 20)
    {
      waits += Calls.Waits - plain.Waits;
      readbacks += Calls.Readbacks;
      EXPECT_LE(Calls.Allocations, plain.Allocations + allocations) << frame;
      // Depths that are read back arrive before they are used.
      EXPECT_EQ(Calls.Readbacks * Calls.Maps, 0) << frame;
    }
  }
  EXPECT_LE(waits, queries);
  EXPECT_LE(readbacks, 5); // one in eight frames
  EXPECT_GT(readbacks, 1); // the calls are counted
}

void Build(OcclusionScene& scene)
{
  scene.AddFloor();
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0.4 });
}

TEST(MovingFrame, DoesNotWaitOrAllocateWhileTheCameraMoves)
{
  OcclusionScene scene;
  Build(scene);
  scene.AddSphere({ 0, 0, 0.5 }, 0.5);
  ExpectNoWaits(
    scene, [&]() { scene.Renderer->GetActiveCamera()->Azimuth(0.25); }, 0, 0);
}

TEST(MovingFrame, WaitsInOneOfNineFramesWhileActorsMove)
{
  OcclusionScene scene;
  Build(scene);
  const auto sphere = scene.AddSphere({ -0.5, 0, 0.5 }, 0.5);
  // The allocated texture holds one matrix per moved actor.
  ExpectNoWaits(
    scene, [&]() { sphere->AddPosition(0.02, 0.0, 0.0); }, 5, 1);
}

}
#endif
