// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What vtkPenumbraRenderView makes of ParaView's picture: occlusion, then light shafts; or, instead of
// all that, a picture by rays. Where ParaView leaves drawing to this process alone, that is what opaque
// props get: translucent ones and volumes come on top. Else it is the picture put together from all ranks.
#ifndef penumbra_RenderViewPass_h
#define penumbra_RenderViewPass_h

#include "Chain/RendererStepsPass.h"

#include "vtkCameraPass.h"
#include "vtkImageProcessingPass.h"
#include "vtkNew.h"
#include "vtkOpaquePass.h"
#include "vtkPenumbraLightShaftPass.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraTemporalSSAOPass.h"

namespace penumbra
{

class RenderViewPass : public vtkImageProcessingPass
{
public:
  static RenderViewPass* New();
  vtkTypeMacro(RenderViewPass, vtkImageProcessingPass);

  vtkNew<vtkPenumbraTemporalSSAOPass> Occlusion;
  vtkNew<vtkPenumbraLightShaftPass> Shafts;
  vtkNew<vtkPenumbraRayCaster> Caster;
  bool UseOcclusion = false;
  bool UseShafts = false;
  bool UseRays = false;
  /// Translucent props or volumes are shown, which come on top of the effects. Otherwise the picture is
  /// made as where several ranks have put it together, so that it is the same.
  bool ShowsMoreThanOpaque = false;

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

private:
  vtkRenderPass* WithEffects(vtkRenderPass* delegate, bool opaqueOnly);
  bool RenderByRays(const vtkRenderState* state);

  vtkNew<RendererStepsPass> Stages;
  vtkNew<vtkCameraPass> Camera;
  vtkNew<vtkOpaquePass> Opaque;
};

}
#endif
