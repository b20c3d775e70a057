// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraRayCastPass
 * @brief   Render pass that ray casts the renderer, with an image that grows while nothing changes.
 *
 * The first frame of a view is a preview from the rays that TimeLimit allows. Each following frame of
 * the same view continues the work, until the image has the same bits as that of RayCaster. An
 * interactor of the window renders these frames automatically while nothing changes. Any change
 * of the scene, the camera, the size or the settings starts again; triangles and BVH are kept while
 * only the view changes.
 *
 * Use it as the pass of a renderer, one pass for each: `renderer->SetPass(pass)`. The image includes
 * the background and the annotations, and replaces the contents of the viewport; the depth buffer is
 * cleared. During hardware selection, in stereo, in tiled windows, and if the ray caster reports an
 * error, the delegate renders the scene instead. Except for hardware selection, one warning explains
 * why.
 */
#ifndef vtkPenumbraRayCastPass_h
#define vtkPenumbraRayCastPass_h

#include "vtkPenumbraRenderingIrradianceModule.h" // for export macro
#include "vtkPenumbraScreenSpacePass.h"
#include "vtkPenumbraSetNumber.h" // for vtkPenumbraSetClampedNumberMacro

#include <memory> // for std::unique_ptr

class vtkPenumbraRayCaster;

class VTKPENUMBRARENDERINGIRRADIANCE_EXPORT vtkPenumbraRayCastPass
  : public vtkPenumbraScreenSpacePass
{
public:
  static vtkPenumbraRayCastPass* New();
  vtkTypeMacro(vtkPenumbraRayCastPass, vtkPenumbraScreenSpacePass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Ray caster whose settings determine the image, and whose statistics and estimated error describe
   * that of the last frame. The pass sets its renderer and its resolution. Default: one with KeepScene
   * and without Layers, which the window draws itself. Null: the default.
   */
  virtual void SetRayCaster(vtkPenumbraRayCaster* caster);
  vtkPenumbraRayCaster* GetRayCaster();
  ///@}

  ///@{
  /**
   * Time in seconds that the ray caster may spend in a frame. A tile of 32x32 pixels, the first
   * extraction of the scene and the build of its BVH are not interrupted. Range: [0.001, 1e6].
   * Default: 0.05.
   */
  vtkPenumbraSetClampedNumberMacro(TimeLimit, 0.001, 1e6);
  vtkGetMacro(TimeLimit, double);
  ///@}

  /** Returns true if the last frame showed the complete image. */
  bool IsComplete();

  void ReleaseGraphicsResources(vtkWindow* w) override;

protected:
  vtkPenumbraRayCastPass();
  ~vtkPenumbraRayCastPass() override;

  bool RenderEffect(const vtkRenderState* state) override;
  const char* GetEffectName() override { return "ray casting"; }

private:
  vtkPenumbraRayCastPass(const vtkPenumbraRayCastPass&) = delete;
  void operator=(const vtkPenumbraRayCastPass&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Implementation;

  double TimeLimit = 0.05;
};

#endif
