// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraRayCaster
 * @brief   A picture of a VTK scene by ray casting, antialiased to a tolerance.
 *
 * Produces one vtkImageData with the point array `Color` (4 floats: unclamped, straight alpha, no
 * gamma; bottom row first). The scene comes from SetRenderer() or, without one, from the data sets
 * on the repeatable input port, drawn white under one headlight with the view reset to their bounds.
 *
 * Antialiasing is [AA]'s: rays through pixel corners, then work only where the four corners of a
 * pixel are not enough. By default the borders are taken from the geometry itself and covered
 * exactly (SILHOUETTES); the paper's subdivision stays selectable.
 *
 * No OpenGL is used and no window is opened.
 */
#ifndef vtkPenumbraRayCaster_h
#define vtkPenumbraRayCaster_h

#include "vtkImageAlgorithm.h"
#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro
#include "vtkSmartPointer.h"                    // for members

#include <memory> // for std::unique_ptr

class vtkFieldData;
class vtkPenumbraEnvironment;
class vtkPenumbraIrradianceProvider;
class vtkPenumbraMedium;
class vtkRenderer;

class VTKPENUMBRAFILTERSRAYCASTING_EXPORT vtkPenumbraRayCaster : public vtkImageAlgorithm
{
public:
  static vtkPenumbraRayCaster* New();
  vtkTypeMacro(vtkPenumbraRayCaster, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The scene: visible actors, camera, lights and background of a renderer. It needs no window.
   * Whatever of it changes (VTK's objects tell by Modified()), the next Update() draws it again.
   * Default: none, the data sets of input port 0 are drawn.
   */
  virtual void SetRenderer(vtkRenderer* renderer);
  vtkRenderer* GetRenderer();
  ///@}

  ///@{
  /** Width and height of the picture in pixels, each 1 to 65535. Default: 1000 x 600. */
  vtkSetVector2Macro(Resolution, int);
  vtkGetVector2Macro(Resolution, int);
  ///@}

  ///@{
  /**
   * The error that the caller accepts: RMSE of every tile of 16x16 pixels, colours in [0, 1].
   * Coverage known from the geometry is exact whatever the tolerance. A warning says where it was not
   * reached, as far as EstimatedError tells; UNIFORM does not look at it. Default: 1/256.
   */
  vtkSetClampMacro(Tolerance, double, 1e-6, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  /** How the share of a pixel that a surface covers is found. */
  enum CoverageMethods
  {
    SILHOUETTES, ///< exact areas between the projected edges of the surfaces; the default
    SUBDIVISION, ///< [AA]: five more rays divide a pixel, down to MaximumLevel
    UNIFORM      ///< UniformSamples x UniformSamples rays in every pixel, for comparison
  };
  ///@{
  /** How coverage is found. Default: SILHOUETTES. */
  vtkSetClampMacro(CoverageMethod, int, SILHOUETTES, UNIFORM);
  vtkGetMacro(CoverageMethod, int);
  ///@}

  ///@{
  /** Samples along each side of a pixel under UNIFORM, 1 to 64. Default: 8. */
  vtkSetClampMacro(UniformSamples, int, 1, 64);
  vtkGetMacro(UniformSamples, int);
  ///@}

  ///@{
  /** Deepest level of subdivision, 0 to 6; level L has sub-pixels of side 2^-L [AA eq. 3]. Default: 3. */
  vtkSetClampMacro(MaximumLevel, int, 0, 6);
  vtkGetMacro(MaximumLevel, int);
  ///@}

  /**
   * Choose MaximumLevel from the viewing distance and the pixel pitch of the display (same unit of
   * length): the eye resolves 2^-13 rad [AA].
   */
  void SetMaximumLevelFromViewing(double distance, double pixelPitch);

  ///@{
  /** Find objects that lie between the corner rays (case 4 of [AA]). Default: on. */
  vtkSetMacro(FindSmallObjects, bool);
  vtkGetMacro(FindSmallObjects, bool);
  vtkBooleanMacro(FindSmallObjects, bool);
  ///@}

  ///@{
  /** Cast hard shadows of the lights. Default: off. */
  vtkSetMacro(Shadows, bool);
  vtkGetMacro(Shadows, bool);
  vtkBooleanMacro(Shadows, bool);
  ///@}

  ///@{
  /**
   * The medium in which light shafts are seen: lights that cast shadows (all but headlights) light it
   * up, single scattering [Shafts eq. 1]. Default: none.
   */
  virtual void SetMedium(vtkPenumbraMedium* medium);
  vtkPenumbraMedium* GetMedium();
  ///@}

  ///@{
  /**
   * Shadow rays for each light along a view ray, 0 to 4096, beside those that find the borders of
   * shafts; 0: as many as Tolerance needs. Default: 0.
   */
  vtkSetClampMacro(LightShaftSteps, int, 0, 4096);
  vtkGetMacro(LightShaftSteps, int);
  ///@}

  ///@{
  /** Darken by ambient occlusion: rgb = colour * (1 - strength * AO). Default: off. */
  vtkSetMacro(AmbientOcclusion, bool);
  vtkGetMacro(AmbientOcclusion, bool);
  vtkBooleanMacro(AmbientOcclusion, bool);
  ///@}

  ///@{
  /** Reach of an occluder in world units; 0: a tenth of the diagonal of the visible bounds. Default: 0. */
  vtkSetClampMacro(AmbientOcclusionRadius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(AmbientOcclusionRadius, double);
  ///@}

  ///@{
  /** How an occluder counts less with its distance: one of vtkPenumbraIrradianceProvider::Falloffs. Default: NO_FALLOFF. */
  vtkSetClampMacro(AmbientOcclusionFalloff, int, 0, 3);
  vtkGetMacro(AmbientOcclusionFalloff, int);
  ///@}

  ///@{
  /** Strength of the darkening in [0, 1]; negative: 1, and 0.6 on surfaces coloured by scalars. Default: -1. */
  vtkSetClampMacro(AmbientOcclusionStrength, double, -1.0, 1.0);
  vtkGetMacro(AmbientOcclusionStrength, double);
  ///@}

  ///@{
  /**
   * Add the light that surfaces throw at each other and that comes from the environment: rgb +=
   * Albedo * diffuse colour * E / pi, E the irradiance. Default: off.
   */
  vtkSetMacro(IndirectLight, bool);
  vtkGetMacro(IndirectLight, bool);
  vtkBooleanMacro(IndirectLight, bool);
  ///@}

  ///@{
  /** Radiance that comes from where nothing is, 0 up. Default: 0, 0, 0. */
  vtkSetVector3Macro(EnvironmentColor, double);
  vtkGetVector3Macro(EnvironmentColor, double);
  ///@}

  ///@{
  /** A picture of the environment, instead of EnvironmentColor. Default: none. */
  virtual void SetEnvironment(vtkPenumbraEnvironment* environment);
  vtkPenumbraEnvironment* GetEnvironment();
  ///@}

  ///@{
  /** Share of indirect light that a white surface throws back, in [0, 1]. Default: 0.5. */
  vtkSetClampMacro(Albedo, double, 0.0, 1.0);
  vtkGetMacro(Albedo, double);
  ///@}

  ///@{
  /** Diffuse reflections of indirect light on its way to the eye, 1 to 64, the last one included. Default: 3. */
  vtkSetClampMacro(Bounces, int, 1, 64);
  vtkGetMacro(Bounces, int);
  ///@}

  ///@{
  /** Who answers for occlusion and indirect light. Default: brute-force rays. */
  virtual void SetIrradianceSource(vtkPenumbraIrradianceProvider* source);
  vtkPenumbraIrradianceProvider* GetIrradianceSource();
  ///@}

  ///@{
  /** Also produce `Depth`, `Normal`, `ObjectId`, `CellId`, `AmbientOcclusion` at pixel centres. Default: off. */
  vtkSetMacro(GeometryArrays, bool);
  vtkGetMacro(GeometryArrays, bool);
  vtkBooleanMacro(GeometryArrays, bool);
  ///@}

  ///@{
  /** Draw the background; off: it is left out, alpha is the covered share. Default: on. */
  vtkSetMacro(Background, bool);
  vtkGetMacro(Background, bool);
  vtkBooleanMacro(Background, bool);
  ///@}

  ///@{
  /** Trace corner rays 16 at a time; off only to measure what that gains. Default: on. */
  vtkSetMacro(Packets, bool);
  vtkGetMacro(Packets, bool);
  vtkBooleanMacro(Packets, bool);
  ///@}

  ///@{
  /** Threads, 0: all. The picture does not depend on it. Default: 0. */
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /** Screen resolution in dots per inch: line widths and point sizes are in points of 1/72 inch. Default: 72. */
  vtkSetClampMacro(DPI, int, 1, 9600);
  vtkGetMacro(DPI, int);
  ///@}

  /**
   * Counts of the last execution, one value an array: `Rays/Primary`, `Rays/Total`, `Rays/PerPixel`,
   * `Pixels/Refined`, ... None when it did not come to its end. Also in the field data of the output.
   */
  vtkFieldData* GetStatistics();

  /** RMS over the picture of the error believed to be made, colours in [0, 1]; NaN without a picture. */
  double GetEstimatedError();

  vtkMTimeType GetMTime() override;

protected:
  vtkPenumbraRayCaster();
  ~vtkPenumbraRayCaster() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkPenumbraRayCaster(const vtkPenumbraRayCaster&) = delete;
  void operator=(const vtkPenumbraRayCaster&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Implementation;

  int Resolution[2] = { 1000, 600 };
  double Tolerance = 1.0 / 256.0;
  int CoverageMethod = SILHOUETTES;
  int UniformSamples = 8;
  int MaximumLevel = 3;
  bool FindSmallObjects = true;
  bool Shadows = false;
  int LightShaftSteps = 0;
  bool AmbientOcclusion = false;
  double AmbientOcclusionRadius = 0.0;
  int AmbientOcclusionFalloff = 0;
  double AmbientOcclusionStrength = -1.0;
  bool IndirectLight = false;
  double EnvironmentColor[3] = { 0.0, 0.0, 0.0 };
  double Albedo = 0.5;
  int Bounces = 3;
  bool GeometryArrays = false;
  bool Background = true;
  bool Packets = true;
  int NumberOfThreads = 0;
  int DPI = 72;
};

#endif
