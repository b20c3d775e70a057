// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraRenderView
 * @brief   ParaView render view with ambient occlusion, light shafts and ray-cast still renders.
 *
 * The passes process the color and depth that ParaView composites from all ranks, so the result
 * does not depend on the number of ranks. A still render meets the tolerance when it appears:
 * screenshots and animations need no further settings. While the view moves, each frame adds a few
 * samples.
 */
#ifndef vtkPenumbraRenderView_h
#define vtkPenumbraRenderView_h

#include "vtkPVRenderView.h"
#include "vtkPenumbraRenderingParaViewModule.h" // for export macro

#include <memory> // for std::unique_ptr
#include <string> // for members

class vtkPenumbraMedium;

class VTKPENUMBRARENDERINGPARAVIEW_EXPORT vtkPenumbraRenderView : public vtkPVRenderView
{
public:
  static vtkPenumbraRenderView* New();
  vtkTypeMacro(vtkPenumbraRenderView, vtkPVRenderView);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Accepted RMSE of a still render over any 16 x 16 pixels, in [0, 1] intensity. Range: [1e-4, 1].
   * Default: 0.01.
   */
  vtkSetClampMacro(PenumbraTolerance, double, 1e-4, 1.0);
  vtkGetMacro(PenumbraTolerance, double);
  ///@}

  ///@{
  /** If on, colors are darkened by ambient occlusion. Default: on. */
  vtkSetMacro(AmbientOcclusion, bool);
  vtkGetMacro(AmbientOcclusion, bool);
  ///@}

  ///@{
  /**
   * Occlusion radius as a fraction of the diagonal of the scene bounds. Range: [1e-4, 10]. Default:
   * 0.1.
   */
  vtkSetClampMacro(OcclusionRadius, double, 1e-4, 10.0);
  vtkGetMacro(OcclusionRadius, double);
  ///@}

  ///@{
  /** Colors are multiplied by 1 - OcclusionStrength * occlusion. Range: [0, 1]. Default: 1. */
  vtkSetClampMacro(OcclusionStrength, double, 0.0, 1.0);
  vtkGetMacro(OcclusionStrength, double);
  ///@}

  ///@{
  /**
   * Name of the occlusion kernel, one of vtkPenumbraKernels, which only need depth. Default:
   * "march".
   */
  void SetOcclusionKernel(const char* name);
  const char* GetOcclusionKernel() const { return this->OcclusionKernel.c_str(); }
  ///@}

  ///@{
  /** If on, light shafts of the sun and of all scene lights are rendered. Default: off. */
  vtkSetMacro(LightShafts, bool);
  vtkGetMacro(LightShafts, bool);
  ///@}

  ///@{
  /**
   * Scattering optical depth of the haze over the diagonal of the scene bounds. Range: [0, 100].
   * Default: 0.25.
   */
  vtkSetClampMacro(ShaftDensity, double, 0.0, 100.0);
  vtkGetMacro(ShaftDensity, double);
  ///@}

  ///@{
  /**
   * Optical depth over the diagonal of the scene bounds that small particles add in green; 0.43 of it
   * in red, 2.44 in blue: blue haze, red suns. Range: [0, 100]. Default: 0.
   */
  vtkSetClampMacro(ShaftRayleigh, double, 0.0, 100.0);
  vtkGetMacro(ShaftRayleigh, double);
  ///@}

  ///@{
  /**
   * Mean cosine of the scattering angle of the haze, without its small particles: 0 in all directions
   * alike, 0.7 a bright glow around the sun. Range: [-0.999, 0.999]. Default: 0.
   */
  vtkSetClampMacro(ShaftAsymmetry, double, -0.999, 0.999);
  vtkGetMacro(ShaftAsymmetry, double);
  ///@}

  ///@{
  /**
   * Height over which the density falls to 1/e, as a fraction of the diagonal of the scene bounds,
   * whose lowest point along ShaftUp has the densities above; 0: the same density everywhere.
   * Range: [0, 1000]. Default: 0.
   */
  vtkSetClampMacro(ShaftScaleHeight, double, 0.0, 1000.0);
  vtkGetMacro(ShaftScaleHeight, double);
  ///@}

  ///@{
  /** Direction in which heights are measured. Default: (0, 1, 0). */
  vtkSetVector3Macro(ShaftUp, double);
  vtkGetVector3Macro(ShaftUp, double);
  ///@}

  ///@{
  /**
   * Source of the shadows of rasterized light shafts, vtkPenumbraLightShaftPass::DEPTH or SHADOW_MAP.
   * If the data are distributed, DEPTH is used. Default: DEPTH.
   */
  vtkSetClampMacro(ShaftEstimator, int, 0, 2);
  vtkGetMacro(ShaftEstimator, int);
  ///@}

  ///@{
  /** Factor of the scattered light; 1 is physically correct. Range: [0, 1000]. Default: 1. */
  vtkSetClampMacro(ShaftExposure, double, 0.0, 1000.0);
  vtkGetMacro(ShaftExposure, double);
  ///@}

  ///@{
  /**
   * Assumed thickness of visible surfaces, as a fraction of the diagonal of the scene bounds.
   * Range: [1e-4, 10]. Default: 0.1.
   */
  vtkSetClampMacro(ShaftThickness, double, 1e-4, 10.0);
  vtkGetMacro(ShaftThickness, double);
  ///@}

  ///@{
  /**
   * Direction from the scene toward the sun, a distant light that exists while LightShafts is on.
   * Default: (1, 1, 1).
   */
  vtkSetVector3Macro(SunDirection, double);
  vtkGetVector3Macro(SunDirection, double);
  ///@}

  ///@{
  /** Intensity of the sun; 0 disables it. Range: [0, 100]. Default: 1. */
  vtkSetClampMacro(SunIntensity, double, 0.0, 100.0);
  vtkGetMacro(SunIntensity, double);
  ///@}

  ///@{
  /**
   * Angular diameter of directional lights in degrees in ray-cast still renders, which then cast
   * penumbrae; that of the sun is 0.53. Range: [0, 180]. Default: 0, hard shadows.
   */
  vtkSetClampMacro(SunAngle, double, 0.0, 180.0);
  vtkGetMacro(SunAngle, double);
  ///@}

  ///@{
  /**
   * If on, still renders are ray cast, with errors of light below PenumbraTolerance and of antialiasing
   * below that and 1/256, by all ranks together if their images are composited. With volumes, the view
   * is rasterized. Default: off.
   */
  vtkSetMacro(StillByRays, bool);
  vtkGetMacro(StillByRays, bool);
  ///@}

  /** Tone mapping disables the effects and rays, with one warning. */
  void SetUseToneMapping(bool use); // hides that of the superclass, which is not virtual

protected:
  vtkPenumbraRenderView();
  ~vtkPenumbraRenderView() override;

  void AboutToRenderOnLocalProcess(bool interactive) override;

private:
  vtkPenumbraRenderView(const vtkPenumbraRenderView&) = delete;
  void operator=(const vtkPenumbraRenderView&) = delete;

  void UpdateSunLight();
  void Configure(bool interactive);
  void ConfigureMedium(vtkPenumbraMedium* medium);
  bool UsesOrderedCompositing();
  bool HasSeveralRanks();
  void AgreeOnRays(bool isPossible);
  void CastDistributedRays();
  void WarnOnce(const char* text);
  void ReportWarning(vtkObject* caller, unsigned long event, void* message);

  struct Internals;
  std::unique_ptr<Internals> Implementation;

  double PenumbraTolerance = 0.01;
  bool AmbientOcclusion = true;
  double OcclusionRadius = 0.1;
  double OcclusionStrength = 1.0;
  std::string OcclusionKernel = "march";
  bool LightShafts = false;
  double ShaftDensity = 0.25;
  double ShaftRayleigh = 0.0;
  double ShaftAsymmetry = 0.0;
  double ShaftScaleHeight = 0.0;
  double ShaftUp[3] = { 0.0, 1.0, 0.0 };
  int ShaftEstimator = 0;
  double ShaftExposure = 1.0;
  double ShaftThickness = 0.1;
  double SunDirection[3] = { 1.0, 1.0, 1.0 };
  double SunIntensity = 1.0;
  double SunAngle = 0.0;
  bool StillByRays = false;
};

#endif
