// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RendererStepsPass.h"

#include "PassSlots.h"

#include "vtkHardwareSelector.h"
#include "vtkHiddenLineRemovalPass.h"
#include "vtkImageProcessingPass.h"
#include "vtkLightsPass.h"
#include "vtkObjectFactory.h"
#include "vtkOpaquePass.h"
#include "vtkOpenGLFXAAFilter.h"
#include "vtkOpenGLRenderer.h"
#include "vtkProp.h"
#include "vtkRenderState.h"

#include <algorithm>

namespace penumbra
{

vtkStandardNewMacro(RendererStepsPass);
vtkStandardNewMacro(RendererCameraPass);

RendererStepsPass::RendererStepsPass()
  : LightsPass(vtkSmartPointer<vtkLightsPass>::New()),
    FXAAFilter(vtkSmartPointer<vtkOpenGLFXAAFilter>::New())
{
}

RendererStepsPass::~RendererStepsPass() = default;

void RendererStepsPass::Render(const vtkRenderState* state)
{
  this->NumberOfRenderedProps = 0;
  auto* renderer = vtkOpenGLRenderer::SafeDownCast(state->GetRenderer());
  vtkProp** props = state->GetPropArray();
  const int count = state->GetPropArrayCount();
  if (!renderer || count == 0)
  {
    return;
  }
  if (renderer->GetUseShadows() && !this->WarnedOfShadows)
  {
    this->WarnedOfShadows = true;
    vtkWarningMacro("vtkRenderer::UseShadows has no effect together with Penumbra's passes. Remove "
                    "the passes, or render shadows with vtkPenumbraRayCaster.");
  }
  if (renderer->GetUseSSAO() && !this->WarnedOfOcclusion)
  {
    this->WarnedOfOcclusion = true;
    vtkWarningMacro(
      "vtkRenderer::UseSSAO has no effect together with Penumbra's passes. Turn it off "
      "and use vtkPenumbraTemporalSSAOPass.");
  }
  this->LightsPass->Render(state);
  if (vtkHardwareSelector* selector = renderer->GetSelector())
  {
    this->NumberOfRenderedProps = selector->Render(renderer, props, count);
    return;
  }

  if (renderer->GetUseHiddenLineRemoval() &&
    vtkHiddenLineRemovalPass::WireframePropsExist(props, count))
  {
    vtkNew<vtkHiddenLineRemovalPass> hiddenLines;
    hiddenLines->Render(state);
    this->NumberOfRenderedProps += hiddenLines->GetNumberOfRenderedProps();
  }
  else
  {
    this->OpaquePass->Render(state);
    this->NumberOfRenderedProps += this->OpaquePass->GetNumberOfRenderedProps();
  }

  const bool translucent = std::any_of(
    props, props + count, [](vtkProp* prop) { return prop->HasTranslucentPolygonalGeometry(); });
  if (translucent)
  {
    renderer->DeviceRenderTranslucentPolygonalGeometry(state->GetFrameBuffer());
  }
  if (renderer->GetUseFXAA())
  {
    this->FXAAFilter->UpdateConfiguration(renderer->GetFXAAOptions());
    this->FXAAFilter->Execute(renderer);
  }
  const bool volumesPeeled =
    translucent && renderer->GetUseDepthPeeling() && renderer->GetUseDepthPeelingForVolumes();
  for (int i = 0; i < count && !volumesPeeled; ++i)
  {
    this->NumberOfRenderedProps += props[i]->RenderVolumetricGeometry(renderer);
  }
  for (int i = 0; i < count; ++i)
  {
    this->NumberOfRenderedProps += props[i]->RenderOverlay(renderer);
  }
}

void RendererStepsPass::ReleaseGraphicsResources(vtkWindow* window)
{
  if (this->OpaquePass)
  {
    this->OpaquePass->ReleaseGraphicsResources(window);
  }
  this->FXAAFilter->ReleaseGraphicsResources();
}

EffectList RendererCameraPass::GetEffects()
{
  EffectList effects;
  for (const PassSlot& slot : FindInnerSlots({ this, nullptr, false }))
  {
    if (vtkImageProcessingPass::SafeDownCast(slot.Pass))
    {
      const EffectList own = FindEffectsOfClass(slot.Pass);
      effects.AmbientOcclusion |= own.AmbientOcclusion;
      effects.LightShafts |= own.LightShafts;
      effects.Other |= own.Other;
    }
  }
  return effects;
}

RendererCameraPass::RendererCameraPass()
{
  this->Steps->SetOpaquePass(vtkNew<vtkOpaquePass>());
  this->SetDelegatePass(this->Steps);
}

}
