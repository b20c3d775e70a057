// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraRayCaster
 * @brief   Renders an image of a VTK scene by ray casting, antialiased to a tolerance.
 *
 * The output is a vtkImageData with the point array `Color` (4 floats: unclamped, straight alpha,
 * no gamma correction; bottom row first). The scene comes from SetRenderer(). Without a renderer,
 * the data sets on the repeatable input port are rendered in white under one headlight, with the
 * camera reset to their bounds.
 *
 * Antialiasing follows [AA]: one ray passes through each pixel corner, and only pixels whose four
 * corners are not sufficient get more work. The edges are projected from the geometry and their
 * coverage is exact.
 *
 * The class uses no OpenGL and opens no window.
 */
#ifndef vtkPenumbraRayCaster_h
#define vtkPenumbraRayCaster_h

#include "vtkImageAlgorithm.h"
#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro
#include "vtkSmartPointer.h"                    // for members

#include <memory> // for std::unique_ptr

namespace penumbra
{
struct RayCasterConstants;
}
class vtkFieldData;
class vtkImageData;
class vtkLight;
class vtkPenumbraEnvironment;
class vtkPenumbraIrradianceProvider;
class vtkPenumbraMedium;
class vtkRenderer;

namespace penumbra
{
class SceneDistribution;
}

class VTKPENUMBRAFILTERSRAYCASTING_EXPORT vtkPenumbraRayCaster : public vtkImageAlgorithm
{
public:
  static vtkPenumbraRayCaster* New();
  vtkTypeMacro(vtkPenumbraRayCaster, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Renderer that provides the scene: visible actors, camera, lights and background. It needs no
   * window. The next Update() renders again if any object of the scene was modified (GetMTime()).
   * Default: none, the data sets of input port 0 are rendered.
   */
  virtual void SetRenderer(vtkRenderer* renderer);
  vtkRenderer* GetRenderer();
  ///@}

  ///@{
  /** Width and height of the image in pixels. Range: [1, 65535] each. Default: 1000 x 600. */
  vtkSetVector2Macro(Resolution, int);
  vtkGetVector2Macro(Resolution, int);
  ///@}

  ///@{
  /**
   * Accepted RMSE of every tile of 16x16 pixels, for colors in [0, 1], that geometry, shading and
   * textures cause. Coverage computed from the geometry is exact for any tolerance. Range: [1e-6, 1]. Default: 1/256.
   */
  vtkSetClampMacro(Tolerance, double, 1e-6, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Accepted RMSE of every tile that light effects add: ambient occlusion, indirect light, lights
   * with a size, and light shafts, for colors in [0, 1]. With at least one of them, the bound of a
   * tile is sqrt(Tolerance^2 + LightTolerance^2). 0: 2.56 times Tolerance, 0.01 at its default, and
   * at most 1. Range: 0 or [1e-6, 1]. Default: 0.
   */
  vtkSetClampMacro(LightTolerance, double, 0.0, 1.0);
  vtkGetMacro(LightTolerance, double);
  ///@}

  /** Accepted RMSE that light effects add: LightTolerance, or, if it is 0, 2.56 times Tolerance. */
  double GetEffectiveLightTolerance();

  ///@{
  /**
   * Time in seconds after which an execution ends its work. The image is then the best one so far: it is
   * complete, and its estimated errors include what is missing. One warning and the statistics
   * `TimeLimit/Reached`, `Pixels/Unfinished` and `Tiles/AboveTolerance` report it. The time of the
   * extraction of the scene, of the BVH, of the preparation of an irradiance provider, of one ray for
   * every 8 x 8 pixels and of GeometryArrays counts, but they are not interrupted. Unless the limit is
   * reached, the image does not depend on it. 0: no limit. Range: >= 0. Default: 0.
   */
  virtual void SetTimeLimit(double seconds);
  vtkGetMacro(TimeLimit, double);
  ///@}

  ///@{
  /**
   * If on, lights cast shadows: hard ones, unless they have a size. Default: as
   * vtkRenderer::UseShadows of Renderer, which is ignored once this option has been set.
   */
  virtual void SetShadows(bool on);
  bool GetShadows();
  vtkBooleanMacro(Shadows, bool);
  ///@}

  ///@{
  /**
   * Radius of positional lights in world units: spheres, and for spotlights (ConeAngle below 90
   * degrees) disks perpendicular to their direction. With Shadows, they cast penumbrae, sampled
   * until the estimated error is within LightTolerance. Surfaces are shaded as by a light at the
   * center, times the fraction of the light that is visible, in solid angle (disks: in area). The part of a
   * light below the horizon of a surface is not visible. Inside the sphere of a light, surfaces are
   * fully lit and cast no shadow; a warning names the light. Light shafts ignore the size.
   * Range: >= 0, finite. Default: 0, hard shadows.
   */
  vtkSetMacro(LightRadius, double);
  vtkGetMacro(LightRadius, double);
  ///@}

  ///@{
  /**
   * Angular diameter of directional lights in degrees, see LightRadius. That of the sun is 0.53.
   * Range: [0, 180]. Default: 0, hard shadows.
   */
  vtkSetMacro(LightAngle, double);
  vtkGetMacro(LightAngle, double);
  ///@}

  ///@{
  /** Radius or angular diameter of one light, which replaces LightRadius or LightAngle for it. */
  void SetLightRadius(vtkLight* light, double radius);
  void SetLightAngle(vtkLight* light, double angle);
  double GetLightRadius(vtkLight* light);
  double GetLightAngle(vtkLight* light);
  ///@}

  /** Remove the radii and angular diameters of individual lights. */
  void ClearLightSizes();

  ///@{
  /**
   * Participating medium in which light shafts are rendered: single scattering [Shafts eq. 1] of
   * the lights that cast shadows, which are all but headlights. Default: none.
   */
  virtual void SetMedium(vtkPenumbraMedium* medium);
  vtkPenumbraMedium* GetMedium();
  ///@}

  ///@{
  /**
   * If on, multiply colors by 1 - AmbientOcclusionStrength * ambient occlusion. Default: as
   * vtkRenderer::UseSSAO of Renderer, which is ignored once this option has been set. While UseSSAO
   * applies, the default radius is vtkRenderer::SSAORadius, and the default strength is 1.
   */
  virtual void SetAmbientOcclusion(bool on);
  bool GetAmbientOcclusion();
  vtkBooleanMacro(AmbientOcclusion, bool);
  ///@}

  ///@{
  /**
   * Maximum distance of an occluder in world units. 0: a tenth of the diagonal of the visible
   * bounds, see also AmbientOcclusion. Default: 0.
   */
  vtkSetClampMacro(AmbientOcclusionRadius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(AmbientOcclusionRadius, double);
  ///@}

  ///@{
  /**
   * Attenuation of an occluder with its distance, one of vtkPenumbraIrradianceProvider::Falloffs.
   * Default: NO_FALLOFF.
   */
  vtkSetClampMacro(AmbientOcclusionFalloff, int, 0, 3);
  vtkGetMacro(AmbientOcclusionFalloff, int);
  void SetAmbientOcclusionFalloffToNone() { this->SetAmbientOcclusionFalloff(0); }
  void SetAmbientOcclusionFalloffToLinear() { this->SetAmbientOcclusionFalloff(1); }
  void SetAmbientOcclusionFalloffToQuadratic() { this->SetAmbientOcclusionFalloff(2); }
  void SetAmbientOcclusionFalloffToSquareRoot() { this->SetAmbientOcclusionFalloff(3); }
  const char* GetAmbientOcclusionFalloffAsString();
  ///@}

  ///@{
  /**
   * Strength of ambient occlusion in [0, 1]. Negative: 1, and 0.6 on surfaces colored by scalars,
   * see also AmbientOcclusion. Default: -1.
   */
  vtkSetClampMacro(AmbientOcclusionStrength, double, -1.0, 1.0);
  vtkGetMacro(AmbientOcclusionStrength, double);
  ///@}

  ///@{
  /**
   * If on, add the light that other surfaces reflect and that the environment emits:
   * Albedo * diffuse color * E / pi, where E is the irradiance. Default: off.
   */
  vtkSetMacro(IndirectLight, bool);
  vtkGetMacro(IndirectLight, bool);
  vtkBooleanMacro(IndirectLight, bool);
  ///@}

  ///@{
  /**
   * Radiance of the environment, returned by rays that hit no surface. Range: >= 0.
   * Default: (0, 0, 0).
   */
  vtkSetVector3Macro(EnvironmentColor, double);
  vtkGetVector3Macro(EnvironmentColor, double);
  ///@}

  ///@{
  /** Environment map, used instead of EnvironmentColor. Default: none. */
  virtual void SetEnvironment(vtkPenumbraEnvironment* environment);
  vtkPenumbraEnvironment* GetEnvironment();
  ///@}

  ///@{
  /** Fraction of indirect light that a white surface reflects. Range: [0, 1]. Default: 0.5. */
  vtkSetClampMacro(Albedo, double, 0.0, 1.0);
  vtkGetMacro(Albedo, double);
  ///@}

  ///@{
  /**
   * Number of diffuse reflections of indirect light on its path to the camera, including the last
   * one. Range: [1, 64]. Default: 3.
   */
  vtkSetClampMacro(Bounces, int, 1, 64);
  vtkGetMacro(Bounces, int);
  ///@}

  ///@{
  /**
   * Object that computes ambient occlusion and irradiance.
   * Default: vtkPenumbraBruteForceIrradiance.
   */
  virtual void SetIrradianceProvider(vtkPenumbraIrradianceProvider* provider);
  vtkPenumbraIrradianceProvider* GetIrradianceProvider();
  ///@}

  ///@{
  /**
   * If on, also output the arrays `Depth`, `Normal`, `ObjectId`, `CellId`, `AmbientOcclusion`
   * (AOVs), sampled at pixel centers. Default: off.
   */
  vtkSetMacro(GeometryArrays, bool);
  vtkGetMacro(GeometryArrays, bool);
  vtkBooleanMacro(GeometryArrays, bool);
  ///@}

  ///@{
  /**
   * If on, render the background. If off, alpha is the covered fraction of the pixel. Default: on.
   */
  vtkSetMacro(Background, bool);
  vtkGetMacro(Background, bool);
  vtkBooleanMacro(Background, bool);
  ///@}

  ///@{
  /** Number of threads; 0: all. The image does not depend on it. Range: [0, 1024]. Default: 0. */
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /**
   * If true, the renderers in layers above that of Renderer in its window are composited over the
   * image where their viewports overlap, such as the one of an orientation widget. Those in layers
   * below are composited under it instead of the background, unless Renderer erases them
   * (vtkRenderer::PreserveColorBuffer is off). They are ray cast with the same tolerances,
   * without indirect light, and with shadows and ambient occlusion only as their own renderers require.
   * Default: true.
   */
  vtkSetMacro(Layers, bool);
  vtkGetMacro(Layers, bool);
  vtkBooleanMacro(Layers, bool);
  ///@}

  ///@{
  /**
   * If on, keep the triangles of Renderer and their BVH for the next images. Only the props that change
   * are extracted again, as long as none is added or removed, the bounds of all visible props remain the
   * same, and no setting of the ray caster changes. This takes
   * memory between the images. The coordinates of the scene are then relative to a point beside its
   * bounds, not to the camera, which changes the rounding of colors. Every image is the same as that
   * of a new ray caster with this option. Scenes with lines, points, images or text whose size or
   * direction depends on the camera are not kept, nor if the camera is inside the bounds of the
   * scene, at less than 0.4 or more than 8 of their radii, or has a high zoom. Default: off.
   */
  vtkSetMacro(KeepScene, bool);
  vtkGetMacro(KeepScene, bool);
  vtkBooleanMacro(KeepScene, bool);
  ///@}

  ///@{
  /**
   * Screen resolution in dots per inch. Line widths and point sizes are in points of 1/72 inch.
   * Range: [1, 9600]. Default: 72.
   */
  vtkSetClampMacro(DPI, int, 1, 9600);
  vtkGetMacro(DPI, int);
  ///@}

  ///@{
  /**
   * Radius of points in world units. All points are then rendered as spheres. 0: as spheres only if
   * vtkProperty::RenderPointsAsSpheres is on, with the radius PointSize / 2 at their depth.
   * Range: [0, inf). Default: 0.
   */
  vtkSetClampMacro(PointRadius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(PointRadius, double);
  ///@}

  ///@{
  /**
   * Radius of lines in world units. Lines and wireframes are then rendered as tubes with round
   * joints and ends. 0: as tubes only if vtkProperty::RenderLinesAsTubes is on, with the radius
   * LineWidth / 2 at the depth of each point. Range: [0, inf). Default: 0.
   */
  vtkSetClampMacro(LineRadius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(LineRadius, double);
  ///@}

  /**
   * Constants of the method, for benchmarks and tests. Their names and meanings may change. Marks the
   * ray caster as modified, so that they may be changed until the next execution.
   */
  penumbra::RayCasterConstants& GetConstants();

  /**
   * Render the image of Renderer a little further, without the pipeline: for about `seconds` seconds,
   * beginning with the time of the preparation of the scene. Stores all that is known of the image in
   * `image`, with the arrays of the output, and updates the statistics and the estimated errors, in which
   * `TimeLimit/Reached` is 1 until the image is complete. The next call continues; it starts again
   * if the scene or a setting was modified in between. The complete image has the same bits as the
   * output; GeometryArrays and Layers are added only to it. A tile of 32x32 pixels and what TimeLimit
   * does not interrupt are not interrupted. TimeLimit has no effect. Returns true if the image is
   * complete. If there is an error, `image` is empty.
   */
  bool RenderFor(double seconds, vtkImageData* image);

  /**
   * Counts of the last execution, one array with one value each: `Rays/Primary`, `Rays/Total`,
   * `Rays/PerPixel`, `Pixels/Refined`, ... Empty if the execution was stopped or failed. The arrays
   * are also in the field data of the output.
   */
  vtkFieldData* GetStatistics();

  /** Estimated RMS error of the image, for colors in [0, 1]; NaN if there is no image. One warning
   * says so if it exceeds its bound, or if that of 4 tiles of 16x16 pixels or of 1 % of all tiles
   * does. The bound is `Tolerance`; with light effects, `sqrt(Tolerance^2 + LightTolerance^2)`. */
  double GetEstimatedError();

  /** Part of the estimated error that light effects cause, see LightTolerance: 0 without them. The
   * squares of this part and of the rest add up to that of GetEstimatedError(). NaN if there is no
   * image. */
  double GetEstimatedLightError();

  /** Phases of an execution. */
  enum Phases
  {
    EXTRACTION, ///< from the renderer or the data sets to triangles
    BUILD,      ///< of the BVH
    EDGES,      ///< of the meshes
    TRACING     ///< all that follows
  };

  /** Elapsed time of one of the Phases of the last execution in seconds; 0 if it did not run. The
   * statistics do not contain times, so that they are the same in every execution. */
  double GetPhaseSeconds(int phase);

  vtkMTimeType GetMTime() override;

protected:
  vtkPenumbraRayCaster();
  ~vtkPenumbraRayCaster() override;

  /// Sets the other ranks that render the next images together with this one; null: none.
  void SetDistribution(penumbra::SceneDistribution* distribution);

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

  friend class vtkPenumbraVectorExporter; // changes the scene and inspects the image
  struct Internals;
  std::unique_ptr<Internals> Implementation;

  int Resolution[2] = { 1000, 600 };
  double Tolerance = 1.0 / 256.0;
  double LightTolerance = 0.0;
  double TimeLimit = 0.0;
  double LightRadius = 0.0;
  double LightAngle = 0.0;
  double AmbientOcclusionRadius = 0.0;
  int AmbientOcclusionFalloff = 0;
  double AmbientOcclusionStrength = -1.0;
  bool IndirectLight = false;
  double EnvironmentColor[3] = { 0.0, 0.0, 0.0 };
  double Albedo = 0.5;
  int Bounces = 3;
  bool GeometryArrays = false;
  bool Background = true;
  int NumberOfThreads = 0;
  int DPI = 72;
  bool Layers = true;
  bool KeepScene = false;
  double PointRadius = 0.0;
  double LineRadius = 0.0;
};

#endif
