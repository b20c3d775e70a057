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
 * The parameters of the medium are those of vtkPenumbraMedium, so that the ray caster renders the
 * same image. The pass has no density image, does not attenuate light on its way to surfaces, and
 * translucent surfaces stand in front of the medium.
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

#include <limits> // for infinite bounds
#include <memory> // for std::unique_ptr

class vtkFieldData;
class vtkImageData;
class vtkLight;
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
   * Number of depth fetches per light and lit fraction. 0: 0.375 / Tolerance, at least 16 and at
   * most one per two blocks of the larger image side; with SHADOW_MAP 1.5 / sqrt(Tolerance), at
   * least 16. Range: [0, 1024]. Default: 0.
   */
  vtkSetClampMacro(Steps, int, 0, 1024);
  vtkGetMacro(Steps, int);
  ///@}

  ///@{
  /**
   * Scattering and extinction coefficients, per world unit. Negative scattering means 0.25 divided
   * by the diagonal of the scene bounds; extinction below scattering means scattering. Defaults:
   * -1.
   */
  vtkPenumbraSetNumberMacro(Scattering);
  vtkGetMacro(Scattering, double);
  vtkPenumbraSetNumberMacro(Extinction);
  vtkGetMacro(Extinction, double);
  ///@}

  ///@{
  /**
   * As in vtkPenumbraMedium: factors on the coefficients in the red, green and blue channel, and
   * Rayleigh scattering in addition, per world unit in green. If the channels differ, the lit
   * fractions are those of the most transparent one. Ranges: >= 0. Defaults: (1, 1, 1) and 0.
   */
  vtkSetVector3Macro(ScatteringColor, double);
  vtkGetVector3Macro(ScatteringColor, double);
  vtkSetVector3Macro(ExtinctionColor, double);
  vtkGetVector3Macro(ExtinctionColor, double);
  vtkPenumbraSetNumberMacro(RayleighScattering);
  vtkGetMacro(RayleighScattering, double);
  ///@}

  ///@{
  /**
   * As in vtkPenumbraMedium: relative density exp(-(h - BaseHeight) / ScaleHeight) at height h
   * along Up; ScaleHeight 0: 1 everywhere. Defaults: 0, 0, (0, 1, 0).
   */
  vtkPenumbraSetNumberMacro(ScaleHeight);
  vtkGetMacro(ScaleHeight, double);
  vtkPenumbraSetNumberMacro(BaseHeight);
  vtkGetMacro(BaseHeight, double);
  vtkSetVector3Macro(Up, double);
  vtkGetVector3Macro(Up, double);
  ///@}

  /** Phase functions, as vtkPenumbraMedium::Phases. */
  enum Phases
  {
    ISOTROPIC,
    RAYLEIGH,
    HENYEY_GREENSTEIN
  };
  ///@{
  /**
   * Phase function (default: ISOTROPIC), and the mean cosine of HENYEY_GREENSTEIN, positive for
   * forward scattering. Range: [-0.999, 0.999]. Default: 0.6.
   */
  vtkSetClampMacro(Phase, int, ISOTROPIC, HENYEY_GREENSTEIN);
  vtkGetMacro(Phase, int);
  vtkPenumbraSetClampedNumberMacro(Asymmetry, -0.999, 0.999);
  vtkGetMacro(Asymmetry, double);
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

  ///@{
  /**
   * Box that the medium fills, in world coordinates (xmin, xmax, ymin, ...); bounds may be
   * infinite. Default: all infinite.
   */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
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
  /**
   * RADIAL [Shafts eq. 4]: Weight is a factor on all samples (>= 0), Decay a factor per 1/64 of the
   * path (range: [0, 1]), Density the ratio of the path to the light to the sampled path (range:
   * [1, 1000]). Defaults: 1.
   */
  vtkPenumbraSetClampedNumberMacro(Weight, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Weight, double);
  vtkPenumbraSetClampedNumberMacro(Decay, 0.0, 1.0);
  vtkGetMacro(Decay, double);
  vtkPenumbraSetClampedNumberMacro(Density, 1.0, 1000.0);
  vtkGetMacro(Density, double);
  ///@}

  /** RADIAL: spacing of the samples. */
  enum Spacings
  {
    EVEN,
    GEOMETRIC ///< each step covers the same fraction of the remaining path to the light
  };
  ///@{
  /**
   * RADIAL: Spacing of samples (default: EVEN) and number of chained passes. Each pass averages
   * Steps samples of the previous one, so that Steps^Passes samples have an effect [Shafts 13.8].
   * More than one pass implies GEOMETRIC. Range: [1, 6]. Default: 1.
   */
  vtkSetClampMacro(Spacing, int, EVEN, GEOMETRIC);
  vtkGetMacro(Spacing, int);
  vtkSetClampMacro(Passes, int, 1, 6);
  vtkGetMacro(Passes, int);
  ///@}

  /** RADIAL: treatment of occluders in the emission image [Shafts 13.5]. */
  enum Occlusions
  {
    MASK,    ///< occluders are black; depth separates them from sky and emitters
    PREPASS, ///< with emitters: the scene is rendered a second time, with black occluders
    CONTRAST ///< occluders emit their color times SurfaceEmission
  };
  ///@{
  /**
   * Treatment of occluders (default: MASK), and the fraction of their color that occluders emit
   * with CONTRAST. Range: [0, 1]. Default: 0.2.
   */
  vtkSetClampMacro(Occlusion, int, MASK, CONTRAST);
  vtkGetMacro(Occlusion, int);
  vtkPenumbraSetClampedNumberMacro(SurfaceEmission, 0.0, 1.0);
  vtkGetMacro(SurfaceEmission, double);
  ///@}

  /** RADIAL: emission of pixels without a surface, multiplied by the color of the light. */
  enum Skies
  {
    WHITE, ///< white; black if there are emitters
    IMAGE  ///< the image behind the scene
  };
  ///@{
  /** Emission of the sky. Default: WHITE. */
  vtkSetClampMacro(Sky, int, WHITE, IMAGE);
  vtkGetMacro(Sky, int);
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

  ///@{
  /**
   * Margin around the image, in which occluders have an effect, in percent of the larger image
   * side. Negative: 20 while a light without a shadow map is outside of the image, else 0. Requires
   * OpaqueOnly. Range: up to 100. Default: -1.
   */
  vtkPenumbraSetClampedNumberMacro(Margin, -1.0, 100.0);
  vtkGetMacro(Margin, double);
  ///@}

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
  int Steps = 0;
  double Scattering = -1.0;
  double Extinction = -1.0;
  double ScatteringColor[3] = { 1.0, 1.0, 1.0 };
  double ExtinctionColor[3] = { 1.0, 1.0, 1.0 };
  double RayleighScattering = 0.0;
  double ScaleHeight = 0.0;
  double BaseHeight = 0.0;
  double Up[3] = { 0.0, 1.0, 0.0 };
  int Phase = ISOTROPIC;
  double Asymmetry = 0.6;
  double Exposure = 1.0;
  bool AutomaticTone = false;
  static constexpr double Infinity = std::numeric_limits<double>::infinity();
  double Bounds[6] = { -Infinity, Infinity, -Infinity, Infinity, -Infinity, Infinity };
  int Estimator = DEPTH;
  double Thickness = 0.0;
  double Weight = 1.0;
  double Decay = 1.0;
  double Density = 1.0;
  int Spacing = EVEN;
  int Passes = 1;
  int Occlusion = MASK;
  double SurfaceEmission = 0.2;
  int Sky = WHITE;
  double Margin = -1.0;
};

#endif
