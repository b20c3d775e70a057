// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Image processing pass of vtkPenumbraRenderView: ambient occlusion followed by light shafts, or a
// ray-cast image instead. If this process renders all props, the effects apply to the opaque props,
// and translucent props and volumes are rendered over them. Otherwise they apply to the composited
// image of all ranks.
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
  /// If on, translucent props or volumes are visible and are rendered over the effects. If off, the
  /// image is processed as a composited image of several ranks, with the same result.
  bool HasNonOpaqueProps = false;

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

private:
  vtkRenderPass* ConnectEffects(vtkRenderPass* delegate, bool opaqueOnly);
  bool RenderRayCast(const vtkRenderState* state);

  vtkNew<RendererStepsPass> Steps;
  vtkNew<vtkCameraPass> Camera;
  vtkNew<vtkOpaquePass> Opaque;
};

}
#endif
