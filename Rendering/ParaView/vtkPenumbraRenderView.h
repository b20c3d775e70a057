// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraRenderView
 * @brief   ParaView's render view with ambient occlusion, light shafts and stills by rays.
 *
 * The passes see the picture that ParaView has put together from all ranks, colour and depth: what
 * they make of it does not depend on how many there are. A still picture has met the tolerance when
 * it appears, so that screenshots and animations need nothing else; while the view moves, each frame
 * adds a few samples.
 */
#ifndef vtkPenumbraRenderView_h
#define vtkPenumbraRenderView_h

#include "vtkPVRenderView.h"
#include "vtkPenumbraRenderingParaViewModule.h" // for export macro

#include <memory> // for std::unique_ptr
#include <string> // for members

class VTKPENUMBRARENDERINGPARAVIEW_EXPORT vtkPenumbraRenderView : public vtkPVRenderView
{
public:
  static vtkPenumbraRenderView* New();
  vtkTypeMacro(vtkPenumbraRenderView, vtkPVRenderView);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** The error accepted in a still picture, 0.0001 to 1. Default: 0.01. */
  vtkSetClampMacro(PenumbraTolerance, double, 1e-4, 1.0);
  vtkGetMacro(PenumbraTolerance, double);
  ///@}

  ///@{
  /** Darken by ambient occlusion. Default: on. */
  vtkSetMacro(AmbientOcclusion, bool);
  vtkGetMacro(AmbientOcclusion, bool);
  ///@}

  ///@{
  /** Reach of an occluder as a share of the diagonal of the scene's bounds, 0.0001 to 10. Default: 0.1. */
  vtkSetClampMacro(OcclusionRadius, double, 1e-4, 10.0);
  vtkGetMacro(OcclusionRadius, double);
  ///@}

  ///@{
  /** Colours are multiplied by 1 - OcclusionStrength * occlusion; 0 to 1. Default: 1. */
  vtkSetClampMacro(OcclusionStrength, double, 0.0, 1.0);
  vtkGetMacro(OcclusionStrength, double);
  ///@}

  ///@{
  /** The kernel by name, one of vtkPenumbraKernels: they need nothing but depth. Default: "march". */
  void SetOcclusionKernel(const char* name);
  const char* GetOcclusionKernel() const { return this->OcclusionKernel.c_str(); }
  ///@}

  ///@{
  /** Show light shafts of the sun and of all lights that stand in the scene. Default: off. */
  vtkSetMacro(LightShafts, bool);
  vtkGetMacro(LightShafts, bool);
  ///@}

  ///@{
  /** Haze: light scattered on a way as long as the diagonal of the bounds, 0 to 100. Default: 0.25. */
  vtkSetClampMacro(ShaftDensity, double, 0.0, 100.0);
  vtkGetMacro(ShaftDensity, double);
  ///@}

  ///@{
  /** Scattered light is multiplied by this, 0 to 1000. Default: 1, physical. */
  vtkSetClampMacro(ShaftExposure, double, 0.0, 1000.0);
  vtkGetMacro(ShaftExposure, double);
  ///@}

  ///@{
  /** How far what is seen reaches back, as a share of the diagonal, 0.0001 to 10. Default: 0.1. */
  vtkSetClampMacro(ShaftThickness, double, 1e-4, 10.0);
  vtkGetMacro(ShaftThickness, double);
  ///@}

  ///@{
  /** A light far away in this direction, with light shafts only. Default: (1, 1, 1). */
  vtkSetVector3Macro(SunDirection, double);
  vtkGetVector3Macro(SunDirection, double);
  ///@}

  ///@{
  /** Its intensity, 0 (none) to 100. Default: 1. */
  vtkSetClampMacro(SunIntensity, double, 0.0, 100.0);
  vtkGetMacro(SunIntensity, double);
  ///@}

  ///@{
  /** Draw still pictures by rays, antialiased to 1/256; where one process has all data. Default: off. */
  vtkSetMacro(StillByRays, bool);
  vtkGetMacro(StillByRays, bool);
  ///@}

protected:
  vtkPenumbraRenderView();
  ~vtkPenumbraRenderView() override;

  void AboutToRenderOnLocalProcess(bool interactive) override;

private:
  vtkPenumbraRenderView(const vtkPenumbraRenderView&) = delete;
  void operator=(const vtkPenumbraRenderView&) = delete;

  void UpdateSunLight();
  void Configure(bool interactive);
  bool UsesOrderedCompositing();
  void WarnOnce(const char* text);

  struct Internals;
  std::unique_ptr<Internals> Implementation;

  double PenumbraTolerance = 0.01;
  bool AmbientOcclusion = true;
  double OcclusionRadius = 0.1;
  double OcclusionStrength = 1.0;
  std::string OcclusionKernel = "march";
  bool LightShafts = false;
  double ShaftDensity = 0.25;
  double ShaftExposure = 1.0;
  double ShaftThickness = 0.1;
  double SunDirection[3] = { 1.0, 1.0, 1.0 };
  double SunIntensity = 1.0;
  bool StillByRays = false;
};

#endif
