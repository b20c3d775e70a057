// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The render steps of vtkOpenGLRenderer (lights, opaque, translucent with or without depth peeling,
// FXAA, volumes, overlays) with a replaceable opaque pass.
#ifndef penumbra_RendererStepsPass_h
#define penumbra_RendererStepsPass_h

#include "PassEffects.h"
#include "vtkCameraPass.h"
#include "vtkNew.h"
#include "vtkOpenGLFXAAFilter.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkPenumbraRenderingScreenSpaceModule.h" // for export macro
#include "vtkSmartPointer.h"

namespace penumbra
{

class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT RendererStepsPass : public vtkOpenGLRenderPass
{
public:
  static RendererStepsPass* New();
  vtkTypeMacro(RendererStepsPass, vtkOpenGLRenderPass);

  void SetOpaquePass(vtkRenderPass* pass) { this->OpaquePass = pass; }
  vtkRenderPass* GetOpaquePass() { return this->OpaquePass; }

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

private:
  RendererStepsPass();
  ~RendererStepsPass() override;

  vtkSmartPointer<vtkRenderPass> OpaquePass;
  vtkSmartPointer<vtkRenderPass> LightsPass;
  vtkSmartPointer<vtkOpenGLFXAAFilter> FXAAFilter;
  bool WarnedOfShadows = false;
  bool WarnedOfOcclusion = false;
};

/// Camera pass of a renderer without other passes: it delegates to the render steps.
class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT RendererCameraPass
  : public vtkCameraPass
  , public PassEffects
{
public:
  static RendererCameraPass* New();
  vtkTypeMacro(RendererCameraPass, vtkCameraPass);

  RendererStepsPass* GetSteps() { return this->Steps; }
  EffectList GetEffects() override;

private:
  RendererCameraPass();

  vtkNew<RendererStepsPass> Steps; ///< of opaque props by vtkOpaquePass, until this is replaced
};

}
#endif
