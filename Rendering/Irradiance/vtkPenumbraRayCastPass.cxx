// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraRayCastPass.h"

#include "Chain/RendererStepsPass.h"
#include "Chain/StaticViewRefiner.h"
#include "Execution/ParallelFor.h"
#include "Frame/OpenGLFunctions.h"
#include "Import/SceneModificationTime.h"

#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPointData.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkPenumbraRayCastPass);

struct vtkPenumbraRayCastPass::Internals
{
  vtkSmartPointer<vtkPenumbraRayCaster> Caster;
  vtkWeakPointer<vtkRenderer> Renderer;
  vtkNew<vtkImageData> Image;
  std::vector<unsigned char> Bytes;
  bool Complete = false;
  vtkMTimeType SceneTime = 0; ///< of the last frame
  penumbra::StaticViewRefiner Refiner;

  /// Continues the image. Returns false if the ray caster has none.
  bool Continue(vtkRenderer* renderer, int width, int height, double seconds);
  void ConvertColors();
  void Draw(vtkOpenGLRenderWindow* window, const int* origin);
};

bool vtkPenumbraRayCastPass::Internals::Continue(
  vtkRenderer* renderer, int width, int height, double seconds)
{
  // The ray caster releases the renderer afterwards: the renderer holds the pass.
  this->Caster->SetRenderer(renderer);
  this->Caster->SetResolution(width, height);
  this->Complete = this->Caster->RenderFor(seconds, this->Image);
  this->Caster->SetRenderer(nullptr);
  return this->Image->GetPointData()->GetArray("Color") != nullptr;
}

void vtkPenumbraRayCastPass::Internals::ConvertColors()
{
  auto* colors = vtkFloatArray::SafeDownCast(this->Image->GetPointData()->GetArray("Color"));
  this->Bytes.resize(static_cast<std::size_t>(colors->GetNumberOfValues()));
  const float* values = colors->GetPointer(0);
  penumbra::ParallelFor<std::size_t>(
    0, this->Bytes.size(), penumbra::ArrayGrain, [&](std::size_t i) {
      this->Bytes[i] = static_cast<unsigned char>(
        255.0 * std::clamp(static_cast<double>(values[i]), 0.0, 1.0) + 0.5);
    });
}

void vtkPenumbraRayCastPass::Internals::Draw(vtkOpenGLRenderWindow* window, const int* origin)
{
  const int* size = this->Image->GetDimensions();
  vtkOpenGLState* gl = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable blend(gl, GL_BLEND);
  const vtkOpenGLState::ScopedglEnableDisable depthTest(gl, GL_DEPTH_TEST);
  const vtkOpenGLState::ScopedglEnableDisable scissor(gl, GL_SCISSOR_TEST);
  gl->vtkglEnable(GL_SCISSOR_TEST);
  gl->vtkglScissor(origin[0], origin[1], size[0], size[1]);
  gl->vtkglDepthMask(GL_TRUE);
  gl->vtkglClearDepth(1.0);
  gl->vtkglClear(GL_DEPTH_BUFFER_BIT);
  gl->vtkglDisable(GL_DEPTH_TEST);
  if (this->Caster->GetBackground())
  {
    gl->vtkglDisable(GL_BLEND);
  }
  else
  {
    gl->vtkglEnable(GL_BLEND);
    gl->vtkglBlendFuncSeparate(
      GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  }
  window->DrawPixels(origin[0], origin[1], origin[0] + size[0] - 1, origin[1] + size[1] - 1, 0, 0,
    size[0] - 1, size[1] - 1, size[0], size[1], 4, VTK_UNSIGNED_CHAR, this->Bytes.data());
}

vtkPenumbraRayCastPass::vtkPenumbraRayCastPass()
  : Implementation(std::make_unique<Internals>())
{
  this->SetRayCaster(nullptr);
  this->SetDelegatePass(vtkNew<penumbra::RendererCameraPass>());
}

vtkPenumbraRayCastPass::~vtkPenumbraRayCastPass() = default;

void vtkPenumbraRayCastPass::SetRayCaster(vtkPenumbraRayCaster* caster)
{
  if (caster && caster == this->Implementation->Caster)
  {
    return;
  }
  this->Implementation->Caster = caster;
  if (!caster)
  {
    this->Implementation->Caster = vtkSmartPointer<vtkPenumbraRayCaster>::New();
    this->Implementation->Caster->KeepSceneOn();
    this->Implementation->Caster->LayersOff();
  }
  this->Modified();
}

vtkPenumbraRayCaster* vtkPenumbraRayCastPass::GetRayCaster()
{
  return this->Implementation->Caster;
}

bool vtkPenumbraRayCastPass::IsComplete()
{
  return this->Implementation->Complete;
}

bool vtkPenumbraRayCastPass::RenderEffect(const vtkRenderState* state)
{
  Internals& internals = *this->Implementation;
  vtkRenderer* renderer = state->GetRenderer();
  if (internals.Renderer && internals.Renderer != renderer)
  {
    this->WarnOnce("The pass renders another renderer already; the scene is rendered without ray "
                   "casting. Give each renderer a pass of its own.");
    return false;
  }
  vtkOpenGLRenderWindow* window = this->EnterWindow(renderer);
  internals.Complete = false;
  if (!window)
  {
    return false;
  }
  const int* tiles = window->GetTileScale();
  if (tiles[0] > 1 || tiles[1] > 1)
  {
    this->WarnOnce(
      "Tiled windows do not support ray casting; the scene is rendered without it. Use "
      "a tile scale of 1.");
    return false;
  }
  internals.Renderer = renderer;
  int size[2];
  int origin[2];
  renderer->GetTiledSizeAndOrigin(&size[0], &size[1], &origin[0], &origin[1]);
  const vtkMTimeType before = std::exchange(internals.SceneTime, penumbra::GetSceneMTime(renderer));
  if (std::min(size[0], size[1]) < 1 ||
    !internals.Continue(renderer, size[0], size[1], this->TimeLimit))
  {
    internals.Refiner.Stop();
    return false;
  }
  internals.ConvertColors();
  internals.Draw(window, origin);
  this->NumberOfRenderedProps = state->GetPropArrayCount();
  internals.Refiner.RecordFrame(renderer, !internals.Complete, internals.SceneTime != before);
  return true;
}

void vtkPenumbraRayCastPass::ReleaseGraphicsResources(vtkWindow* w)
{
  this->Superclass::ReleaseGraphicsResources(w);
  this->Implementation->Refiner.Stop();
  this->Implementation->Renderer = nullptr;
}

void vtkPenumbraRayCastPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RayCaster: " << this->GetRayCaster() << "\n";
  os << indent << "TimeLimit: " << this->TimeLimit << "\n";
  os << indent << "Complete: " << this->IsComplete() << "\n";
}
