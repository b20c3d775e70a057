// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraLightShaftPass
 * @brief   Light shafts in a medium, computed from color and depth [Shafts].
 *
 * The medium attenuates light along every view ray and adds the light that it scatters. The
 * in-scattering of a fully lit ray has a closed form [Shafts eq. 1], which is multiplied by the lit
 * fraction of the ray (eq. 2). By default, one march through the depth buffer toward the light
 * finds the shadowed intervals of the ray; the radial blur of the paper or a shadow map of each
 * light can be selected instead.
 * With the same vtkPenumbraMedium, the ray caster renders the same image. The pass ignores its
 * density image, with one warning, does not attenuate light on its way to surfaces, and translucent
 * surfaces stand in front of the medium.
 *
 * AddTo() sets up everything on a renderer in one call, RemoveFrom() restores it. All lights of the
 * renderer except headlights cast shafts, or only those given to AddLight(). A static scene is
 * computed once.
 */
#ifndef vtkPenumbraLightShaftPass_h
#define vtkPenumbraLightShaftPass_h

#include "vtkPenumbraRenderingScreenSpaceModule.h" // for export macro
#include "vtkPenumbraScreenSpacePass.h"
#include "vtkPenumbraSetNumber.h" // for setters

#include <memory> // for std::unique_ptr

namespace penumbra
{
struct ShaftConstants;
}
class vtkFieldData;
class vtkImageData;
class vtkLight;
class vtkPenumbraMedium;
class vtkProp;
class vtkRenderer;

class VTKPENUMBRARENDERINGSCREENSPACE_EXPORT vtkPenumbraLightShaftPass
  : public vtkPenumbraScreenSpacePass
{
public:
  static vtkPenumbraLightShaftPass* New();
  vtkTypeMacro(vtkPenumbraLightShaftPass, vtkPenumbraScreenSpacePass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Add light shafts to a renderer, or remove them: below its translucent geometry, volumes and
   * overlays, and above ambient occlusion. AddTo() returns the new pass, or the existing one if
   * there is one. FindIn() returns the pass that is part of those of the renderer, null if there is
   * none.
   */
  static vtkPenumbraLightShaftPass* AddTo(vtkRenderer* renderer);
  static void RemoveFrom(vtkRenderer* renderer);
  static vtkPenumbraLightShaftPass* FindIn(vtkRenderer* renderer);
  ///@}

  ///@{
  /**
   * Accepted RMSE of colors. It determines the default of Steps and the size of the blocks of
   * pixels that share a lit fraction: 2x2 from 1/512 on, 3x3 from 1/256 on, 4x4 from 1/128 on.
   * Range: [1e-4, 1]. Default: 1/256.
   */
  vtkPenumbraSetClampedNumberMacro(Tolerance, 1e-4, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Medium that fills the scene. If its channels differ, the lit fractions are those of the most
   * transparent one. Default, also for null: a vtkPenumbraMedium with its defaults.
   */
  virtual void SetMedium(vtkPenumbraMedium* medium);
  vtkPenumbraMedium* GetMedium();
  ///@}

  ///@{
  /** Factor on the in-scattered light [Shafts eq. 4]; 1 is physical. Range: >= 0. Default: 1. */
  vtkPenumbraSetClampedNumberMacro(Exposure, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Exposure, double);
  ///@}

  ///@{
  /**
   * If on, the in-scattered light is also multiplied by an automatic gain [Shafts 13.8], with which
   * its maximum added to the mean brightness of the scene reaches 1. The first frame determines the
   * gain, later ones adapt it gradually; in motion, with a delay of two frames. The result is then
   * not physical. Default: off.
   */
  vtkSetMacro(AutomaticTone, bool);
  vtkGetMacro(AutomaticTone, bool);
  vtkBooleanMacro(AutomaticTone, bool);
  ///@}

  /** Estimators of the lit fraction of a view ray. */
  enum Estimators
  {
    DEPTH,     ///< shadowed intervals, from the depth buffer along the path to the light
    RADIAL,    ///< radial blur: mean emission along the path to the light [Shafts eq. 3 and 4]
    SHADOW_MAP ///< comparisons with a shadow map of each light
  };
  ///@{
  /**
   * Estimator of the lit fraction. With SHADOW_MAP, hidden and off-screen occluders cast shafts and
   * the error follows Tolerance. A positional light without a cone of at most 80 degrees, inside
   * the bounds of the scene or close to them, is estimated by DEPTH, with one warning. Default:
   * DEPTH.
   */
  vtkSetClampMacro(Estimator, int, DEPTH, SHADOW_MAP);
  vtkGetMacro(Estimator, int);
  void SetEstimatorToDepth() { this->SetEstimator(DEPTH); }
  void SetEstimatorToRadial() { this->SetEstimator(RADIAL); }
  void SetEstimatorToShadowMap() { this->SetEstimator(SHADOW_MAP); }
  const char* GetEstimatorAsString() const;
  ///@}

  ///@{
  /**
   * DEPTH: assumed thickness of visible surfaces, in world units. 0: the mean of the smallest
   * extents of the props. Range: >= 0. Default: 0.
   */
  vtkPenumbraSetClampedNumberMacro(Thickness, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Thickness, double);
  ///@}

  ///@{
  /** RADIAL: props that emit the color with which they are rendered. Default: none. */
  void AddEmitter(vtkProp* prop);
  void RemoveAllEmitters();
  ///@}

  ///@{
  /**
   * Lights of the renderer that cast shafts. Default: none added, in which case all except
   * headlights do.
   */
  void AddLight(vtkLight* light);
  void RemoveAllLights();
  ///@}

  /** Constants of the method, for benchmarks and tests. Their names and meanings may change. */
  penumbra::ShaftConstants& GetConstants();

  void ReleaseGraphicsResources(vtkWindow* w) override;

  /**
   * Statistics of the last frame, one value per array: `Lights/Shaft` (number of lights),
   * `LitFractions/Computed` (number of lit fractions; 0 in a static scene),
   * `Samples/PerLitFraction` (depth fetches for each), `ShadowMaps/Size` (texels per side; 0
   * without SHADOW_MAP), `ShadowMaps/Rendered` (number of maps; 0 if neither props nor lights
   * changed), `Light/Gain` (1 without AutomaticTone).
   */
  vtkFieldData* GetStatistics();

  /**
   * Fill `image` with float arrays of the last frame: `LightShafts` (3 components, the added light)
   * and `Transmittance`.
   */
  void CopyShafts(vtkImageData* image);

protected:
  vtkPenumbraLightShaftPass();
  ~vtkPenumbraLightShaftPass() override;

  bool RenderEffect(const vtkRenderState* state) override;
  const char* GetEffectName() override { return "light shafts"; }

private:
  vtkPenumbraLightShaftPass(const vtkPenumbraLightShaftPass&) = delete;
  void operator=(const vtkPenumbraLightShaftPass&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Implementation;

  double Tolerance = 1.0 / 256.0;
  double Exposure = 1.0;
  bool AutomaticTone = false;
  int Estimator = DEPTH;
  double Thickness = 0.0;
};

#endif
