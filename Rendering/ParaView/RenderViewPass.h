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
#include "vtkPenumbraDistributedRayCaster.h"
#include "vtkPenumbraLightShaftPass.h"
#include "vtkPenumbraTemporalSSAOPass.h"
#include "vtkSmartPointer.h"

#include <optional>

class vtkImageData;

namespace penumbra
{

/// Background of a renderer. Compositing replaces it by black while the ranks render.
struct RendererBackground
{
  double First[3] = { 0.0, 0.0, 0.0 };
  double Second[3] = { 0.0, 0.0, 0.0 };
  bool IsGradient = false;
  bool IsTextured = false;

  explicit RendererBackground(vtkRenderer* renderer);
  void Apply(vtkRenderer* renderer) const;
};

class RenderViewPass : public vtkImageProcessingPass
{
public:
  static RenderViewPass* New();
  vtkTypeMacro(RenderViewPass, vtkImageProcessingPass);

  vtkNew<vtkPenumbraTemporalSSAOPass> Occlusion;
  vtkNew<vtkPenumbraLightShaftPass> Shafts;
  vtkNew<vtkPenumbraDistributedRayCaster> Caster;
  bool UseOcclusion = false;
  bool UseShafts = false;
  bool UseRays = false;
  /// If on, CastRays() renders the image on all ranks before the renderers do.
  bool HasDistributedRays = false;
  /// Of the renderer before it is composited.
  std::optional<RendererBackground> DistributedBackground;
  /// If on, translucent props or volumes are visible and are rendered over the effects. If off, the
  /// image is processed as a composited image of several ranks, with the same result.
  bool HasNonOpaqueProps = false;

  /// Renders the image of UseRays; with HasDistributedRays, together with the other ranks, all of which must
  /// call it.
  void CastRays(vtkRenderer* renderer);

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

private:
  vtkRenderPass* ConnectEffects(vtkRenderPass* delegate, bool opaqueOnly);
  bool DrawRayCast(const vtkRenderState* state);

  vtkSmartPointer<vtkImageData> RayImage; ///< of CastRays(); null: none

  vtkNew<RendererStepsPass> Steps;
  vtkNew<vtkCameraPass> Camera;
  vtkNew<vtkOpaquePass> Opaque;
};

}
#endif
