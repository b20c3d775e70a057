// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What vtkPenumbraRenderView makes of ParaView's picture: occlusion, then light shafts; or, instead of
// all that, a picture by rays.
#ifndef penumbra_ViewPass_h
#define penumbra_ViewPass_h

#include "vtkImageProcessingPass.h"
#include "vtkNew.h"
#include "vtkPenumbraLightShaftPass.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraTemporalSSAOPass.h"

namespace penumbra
{

class ViewPass : public vtkImageProcessingPass
{
public:
  static ViewPass* New();
  vtkTypeMacro(ViewPass, vtkImageProcessingPass);

  vtkNew<vtkPenumbraTemporalSSAOPass> Occlusion;
  vtkNew<vtkPenumbraLightShaftPass> Shafts;
  vtkNew<vtkPenumbraRayCaster> Caster;
  bool UseOcclusion = false;
  bool UseShafts = false;
  bool UseRays = false;

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

private:
  bool RenderByRays(const vtkRenderState* state);
};

}
#endif
