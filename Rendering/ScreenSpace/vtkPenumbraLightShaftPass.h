// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraLightShaftPass
 * @brief   Light shafts in haze, from colour and depth alone [Shafts].
 *
 * A homogeneous medium takes light away along every view ray and adds what it scatters of each light:
 * what a lit ray scatters is a closed form [Shafts eq. 1], times the share of the ray that is lit
 * (eq. 2). That share comes from depth: one march over the screen towards the light tells which
 * distances of the view ray are shadowed. The paper's mean of a mask stays selectable. Parameters of
 * the medium are those of vtkPenumbraMedium, the ray caster's, so that both make the same picture.
 *
 * AddTo() sets up everything on a renderer in one call, RemoveFrom() restores it. Lights are those of
 * the renderer but for headlights, or those that AddLight() marks. A still scene is computed once.
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
   * Show light shafts in a renderer: under its translucent geometry, volumes and overlays, over
   * ambient occlusion that it already has. Returns the pass at work, also when there is one already.
   */
  static vtkPenumbraLightShaftPass* AddTo(vtkRenderer* renderer);
  static void RemoveFrom(vtkRenderer* renderer);
  ///@}

  ///@{
  /**
   * The error accepted in a colour, RMSE, 0.0001 to 1: it chooses Steps, and lit shares are found for
   * 2x2 (from 1/512 on), 3x3 (1/256) or 4x4 pixels (1/128) together. Default: 1/256.
   */
  vtkPenumbraSetClampedNumberMacro(Tolerance, 1e-4, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Depths fetched for each light and lit share, 0 to 1024; 0: three eighths over Tolerance, at most one
   * for every two blocks of the picture's larger side. Default: 0.
   */
  vtkSetClampMacro(Steps, int, 0, 1024);
  vtkGetMacro(Steps, int);
  ///@}

  ///@{
  /**
   * Shares of light scattered and lost per world unit. Negative scattering: a quarter over the bounds'
   * diagonal; extinction below scattering means scattering. Defaults: -1.
   */
  vtkPenumbraSetNumberMacro(Scattering);
  vtkGetMacro(Scattering, double);
  vtkPenumbraSetNumberMacro(Extinction);
  vtkGetMacro(Extinction, double);
  ///@}

  /** Where scattered light goes; as vtkPenumbraMedium::Phases. */
  enum Phases
  {
    ISOTROPIC,
    RAYLEIGH,
    HENYEY_GREENSTEIN
  };
  ///@{
  /**
   * The phase function, default ISOTROPIC; for HENYEY_GREENSTEIN the mean cosine, -0.999 to 0.999,
   * positive: forward, default 0.6.
   */
  vtkSetClampMacro(Phase, int, ISOTROPIC, HENYEY_GREENSTEIN);
  vtkGetMacro(Phase, int);
  vtkPenumbraSetClampedNumberMacro(Asymmetry, -0.999, 0.999);
  vtkGetMacro(Asymmetry, double);
  ///@}

  ///@{
  /** Scattered light is multiplied by this [Shafts eq. 4], 0 or more. Default: 1, physical. */
  vtkPenumbraSetClampedNumberMacro(Exposure, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Exposure, double);
  ///@}

  ///@{
  /**
   * Chooses a gain for scattered light [Shafts 13.8], so that its brightest has room over the mean
   * picture: neither too bright nor too dim. The first picture settles it, later ones move it little
   * by little. For pictures to look at; off: light as Exposure says. Default: off.
   */
  vtkSetMacro(AutomaticTone, bool);
  vtkGetMacro(AutomaticTone, bool);
  vtkBooleanMacro(AutomaticTone, bool);
  ///@}

  ///@{
  /**
   * The box that the medium fills, in world coordinates (xmin, xmax, ymin, ...), any of them infinite.
   * Default: everywhere.
   */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}

  /** How the lit share of a view ray is found. */
  enum Estimators
  {
    DEPTH, ///< which distances are shadowed, from depth along the way to the light
    RADIAL ///< mean of a mask on the way to the light [Shafts eq. 3 and 4]
  };
  ///@{
  /** Default: DEPTH. */
  vtkSetClampMacro(Estimator, int, DEPTH, RADIAL);
  vtkGetMacro(Estimator, int);
  ///@}

  ///@{
  /**
   * DEPTH: how far what is seen reaches back, in world units; 0: the mean of the props' smallest
   * extents. Default: 0.
   */
  vtkPenumbraSetClampedNumberMacro(Thickness, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Thickness, double);
  ///@}

  ///@{
  /**
   * RADIAL: a factor of each sample (0 or more) and one for each 1/64 of the way (0 to 1); by how much
   * the way is shorter than that to the light (1 to 1000) [Shafts eq. 4]. Defaults: 1.
   */
  vtkPenumbraSetClampedNumberMacro(Weight, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Weight, double);
  vtkPenumbraSetClampedNumberMacro(Decay, 0.0, 1.0);
  vtkGetMacro(Decay, double);
  vtkPenumbraSetClampedNumberMacro(Density, 1.0, 1000.0);
  vtkGetMacro(Density, double);
  ///@}

  /** RADIAL: the distances between samples. */
  enum Spacings
  {
    EVEN,
    GEOMETRIC ///< each step covers the same share of what is left of the way to the light
  };
  ///@{
  /**
   * Default: EVEN. Chained passes of Steps samples, each over the one before, do the work of
   * Steps^Passes samples [Shafts 13.8]; more than one means GEOMETRIC. 1 to 6. Default: 1.
   */
  vtkSetClampMacro(Spacing, int, EVEN, GEOMETRIC);
  vtkGetMacro(Spacing, int);
  vtkSetClampMacro(Passes, int, 1, 6);
  vtkGetMacro(Passes, int);
  ///@}

  /** RADIAL: how occluders are kept from glowing [Shafts 13.5]. */
  enum Occlusions
  {
    MASK,    ///< depth tells what is sky and what stands before emitters
    PREPASS, ///< with emitters: occluders are drawn black first, a second drawing of the scene
    CONTRAST ///< they glow in their own colours times SurfaceEmission
  };
  ///@{
  /** Default: MASK. With CONTRAST SurfaceEmission is left of an occluder's colour, 0 to 1, default 0.2. */
  vtkSetClampMacro(Occlusion, int, MASK, CONTRAST);
  vtkGetMacro(Occlusion, int);
  vtkPenumbraSetClampedNumberMacro(SurfaceEmission, 0.0, 1.0);
  vtkGetMacro(SurfaceEmission, double);
  ///@}

  /** RADIAL: what glows in the sky, times the light's colour. */
  enum Skies
  {
    WHITE,  ///< all of it; nothing where there are emitters
    PICTURE ///< as the picture behind the scene shows it
  };
  ///@{
  /** Default: WHITE. */
  vtkSetClampMacro(Sky, int, WHITE, PICTURE);
  vtkGetMacro(Sky, int);
  ///@}

  ///@{
  /** RADIAL: props that glow as they are seen. Default: none. */
  void AddEmitter(vtkProp* prop);
  void RemoveAllEmitters();
  ///@}

  ///@{
  /**
   * Only these lights of the renderer make shafts. Default: none marked, then all but headlights do.
   */
  void AddLight(vtkLight* light);
  void RemoveAllLights();
  ///@}

  ///@{
  /**
   * Drawn around the picture so that occluders just outside count: per cent of its larger side, 0 to
   * 100; negative: 20 while a light is outside of the picture, else none. Needs OpaqueOnly.
   * Default: -1.
   */
  vtkPenumbraSetClampedNumberMacro(Margin, -1.0, 100.0);
  vtkGetMacro(Margin, double);
  ///@}

  void ReleaseGraphicsResources(vtkWindow* window) override;

  /**
   * Of the last frame, one value an array: `Lights/Shaft`, `LitFractions/Computed` (lit shares found anew; 0 in
   * a still scene), `Samples/PerLitFraction` (depths fetched for each), `Light/Gain` (1 without
   * AutomaticTone).
   */
  vtkFieldData* GetStatistics();

  /** Fill `image` with the last frame's float arrays `LightShafts` (3, what is added) and `Transmittance`. */
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
  int Phase = ISOTROPIC;
  double Asymmetry = 0.6;
  double Exposure = 1.0;
  bool AutomaticTone = false;
  static constexpr double Endless = std::numeric_limits<double>::infinity();
  double Bounds[6] = { -Endless, Endless, -Endless, Endless, -Endless, Endless };
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
