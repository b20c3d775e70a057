// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RenderViewPass.h"

#include "Frame/OpenGLFunctions.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPointData.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkWindow.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace penumbra
{

vtkStandardNewMacro(RenderViewPass);

namespace
{

/// Returns whether the pass renders all props in this process, inside ParaView's camera pass.
bool RendersAllProps(vtkRenderPass* delegate)
{
  auto* camera = vtkCameraPass::SafeDownCast(delegate);
  return camera && camera->GetDelegatePass() && camera->GetDelegatePass()->IsA("vtkPVDefaultPass");
}

}

void RenderViewPass::Render(const vtkRenderState* state)
{
  if (this->HasDistributedRays)
  {
    // Other ranks wait for this one to composite their images, which the ray-cast image replaces.
    this->DelegatePass->Render(state);
    this->NumberOfRenderedProps = this->DelegatePass->GetNumberOfRenderedProps();
    this->DrawRayCast(state);
    return;
  }
  if (this->UseRays && this->DrawRayCast(state))
  {
    return;
  }
  vtkRenderPass* pass = this->Camera;
  if (this->HasNonOpaqueProps && RendersAllProps(this->DelegatePass))
  {
    this->Steps->SetOpaquePass(this->ConnectEffects(this->Opaque, true));
    this->Camera->SetDelegatePass(this->Steps);
  }
  else
  {
    pass = this->ConnectEffects(this->DelegatePass, false);
  }
  pass->Render(state);
  this->NumberOfRenderedProps = pass->GetNumberOfRenderedProps();
}

vtkRenderPass* RenderViewPass::ConnectEffects(vtkRenderPass* delegate, bool opaqueOnly)
{
  vtkRenderPass* pass = delegate;
  if (this->UseOcclusion)
  {
    this->Occlusion->SetOpaqueOnly(opaqueOnly);
    this->Occlusion->SetDelegatePass(pass);
    pass = this->Occlusion;
  }
  if (this->UseShafts)
  {
    this->Shafts->SetOpaqueOnly(opaqueOnly);
    this->Shafts->SetDelegatePass(pass);
    pass = this->Shafts;
  }
  return pass;
}

RendererBackground::RendererBackground(vtkRenderer* renderer)
  : IsGradient(renderer->GetGradientBackground()),
    IsTextured(renderer->GetTexturedBackground())
{
  renderer->GetBackground(this->First);
  renderer->GetBackground2(this->Second);
}

void RendererBackground::Apply(vtkRenderer* renderer) const
{
  renderer->SetBackground(this->First[0], this->First[1], this->First[2]);
  renderer->SetBackground2(this->Second[0], this->Second[1], this->Second[2]);
  renderer->SetGradientBackground(this->IsGradient);
  renderer->SetTexturedBackground(this->IsTextured);
}

void RenderViewPass::CastRays(vtkRenderer* renderer)
{
  this->RayImage = nullptr;
  const int* tiles = renderer->GetRenderWindow()->GetTileScale();
  int isPossible = !renderer->GetSelector() && tiles[0] == 1 && tiles[1] == 1;
  vtkMultiProcessController* controller =
    this->HasDistributedRays ? vtkMultiProcessController::GetGlobalController() : nullptr;
  if (controller)
  {
    controller->Broadcast(&isPossible, 1, 0);
  }
  if (!isPossible)
  {
    return;
  }
  int size[2];
  int origin[2];
  renderer->GetTiledSizeAndOrigin(&size[0], &size[1], &origin[0], &origin[1]);
  // The ray caster warns about renderers with a pass, so the pass is removed meanwhile. The
  // renderer is released afterwards to avoid a reference cycle.
  const vtkSmartPointer<vtkRenderPass> rendererPass = renderer->GetPass();
  renderer->SetPass(nullptr);
  const RendererBackground background(renderer);
  if (this->HasDistributedRays && this->DistributedBackground)
  {
    this->DistributedBackground->Apply(renderer);
  }
  this->Caster->SetController(controller);
  this->Caster->SetRenderer(renderer);
  this->Caster->LayersOff(); // the view draws them over the image
  this->Caster->SetResolution(size);
  this->Caster->Modified(); // all ranks execute, also those without changes
  this->Caster->Update();
  this->Caster->SetRenderer(nullptr);
  renderer->SetPass(rendererPass);
  background.Apply(renderer);
  if (this->Caster->GetOutput()->GetPointData()->GetArray("Color"))
  {
    this->RayImage = this->Caster->GetOutput();
  }
}

bool RenderViewPass::DrawRayCast(const vtkRenderState* state)
{
  vtkRenderer* renderer = state->GetRenderer();
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!this->HasDistributedRays)
  {
    this->CastRays(renderer);
  }
  int size[2];
  int origin[2];
  renderer->GetTiledSizeAndOrigin(&size[0], &size[1], &origin[0], &origin[1]);
  vtkDataArray* colors =
    this->RayImage ? this->RayImage->GetPointData()->GetArray("Color") : nullptr;
  if (!colors || colors->GetNumberOfTuples() != static_cast<vtkIdType>(size[0]) * size[1])
  {
    return false;
  }
  std::vector<unsigned char> bytes(4 * static_cast<std::size_t>(size[0]) * size[1]);
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    double rgba[4];
    colors->GetTuple(i, rgba);
    for (int k = 0; k < 4; ++k)
    {
      const double value = std::clamp(rgba[k], 0.0, 1.0);
      bytes[4 * static_cast<std::size_t>(i) + k] =
        static_cast<unsigned char>(std::lround(255.0 * value));
    }
  }
  vtkOpenGLState* gl = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable blend(gl, GL_BLEND);
  const vtkOpenGLState::ScopedglEnableDisable depthTest(gl, GL_DEPTH_TEST);
  gl->vtkglDisable(GL_BLEND);
  gl->vtkglDisable(GL_DEPTH_TEST);
  window->DrawPixels(origin[0], origin[1], origin[0] + size[0] - 1, origin[1] + size[1] - 1, 0, 0,
    size[0] - 1, size[1] - 1, size[0], size[1], 4, VTK_UNSIGNED_CHAR, bytes.data());
  this->NumberOfRenderedProps = state->GetPropArrayCount();
  return true;
}

void RenderViewPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Occlusion->ReleaseGraphicsResources(window);
  this->Shafts->ReleaseGraphicsResources(window);
  this->Steps->ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

}
