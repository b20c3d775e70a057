// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraIrradianceFilter
 * @brief   Bakes ambient occlusion, irradiance or direct light onto a mesh, within a tolerance.
 *
 * Adds the array `AmbientOcclusion` (0 unoccluded, 1 occluded), `Irradiance` (red, green and
 * blue; pi under a white sky) or `DirectLight` (1 where one light is visible and straight above
 * the surface) to a copy of the input. The input is any vtkPointSet with a surface,
 * or points only with PointRadius. The hemisphere of a point is centered on its normal, which is
 * read from the input or computed from the polygons. Surfaces occlude from both sides. The blocks
 * of a composite data set form one scene and occlude each other.
 *
 * Geometry that occludes and reflects light but receives no values, such as a floor or the pieces
 * of other processes, goes to input port 1 (optional, vtkPolyData).
 *
 * Values are interpolated between cache records as long as this costs less than rays at every
 * point. For occlusion, the remaining points first get a few rays each, and a local linear fit over
 * neighboring points reduces the noise. Points with a poor fit get more rays. Points without a cell
 * and points that are not finite get 0 and are counted. If aborted, the output is the input without
 * the array.
 */
#ifndef vtkPenumbraIrradianceFilter_h
#define vtkPenumbraIrradianceFilter_h

#include "vtkPassInputTypeAlgorithm.h"
#include "vtkPenumbraFiltersIrradianceModule.h" // for export macro
#include "vtkSmartPointer.h"                    // for members

#include <array>   // for members
#include <string>  // for members
#include <utility> // for members
#include <vector>  // for members

class vtkFieldData;
class vtkPenumbraEnvironment;
class vtkPenumbraGatherer;
class vtkPointSet;
class vtkPolyData;

namespace penumbra
{
class OccluderDistribution;
}

class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT vtkPenumbraIrradianceFilter
  : public vtkPassInputTypeAlgorithm
{
public:
  static vtkPenumbraIrradianceFilter* New();
  vtkTypeMacro(vtkPenumbraIrradianceFilter, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Quantities that can be baked. */
  enum Quantities
  {
    AMBIENT_OCCLUSION, ///< occluded fraction of the hemisphere within Radius, cosine-weighted
    IRRADIANCE,        ///< direct and reflected light of the environment
    DIRECT_LIGHT       ///< sum over the lights: visible fraction times the cosine at the surface
  };
  ///@{
  /** Quantity to bake. Default: AMBIENT_OCCLUSION. */
  vtkSetClampMacro(Quantity, int, AMBIENT_OCCLUSION, DIRECT_LIGHT);
  vtkGetMacro(Quantity, int);
  void SetQuantityToAmbientOcclusion() { this->SetQuantity(AMBIENT_OCCLUSION); }
  void SetQuantityToIrradiance() { this->SetQuantity(IRRADIANCE); }
  void SetQuantityToDirectLight() { this->SetQuantity(DIRECT_LIGHT); }
  const char* GetQuantityAsString();
  ///@}

  ///@{
  /**
   * Accepted RMSE over all points, in the unit of the output array. For irradiance, it holds in every
   * channel and is relative to the radiance of the environment, averaged over the sphere: bright and
   * dark environments cost the same. Range: [1e-4, 1]. Default: 0.01.
   */
  vtkSetClampMacro(Tolerance, double, 1e-4, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Maximum distance of an occluder in world units; may be infinite. 0 uses a tenth of the diagonal
   * of the bounds of both inputs. Range: >= 0. Default: 0.
   */
  vtkSetClampMacro(Radius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Distance falloff of occluders, one of vtkPenumbraIrradianceProvider::Falloffs.
   * Default: NO_FALLOFF.
   */
  vtkSetClampMacro(Falloff, int, 0, 3);
  vtkGetMacro(Falloff, int);
  void SetFalloffToNone() { this->SetFalloff(0); }
  void SetFalloffToLinear() { this->SetFalloff(1); }
  void SetFalloffToQuadratic() { this->SetFalloff(2); }
  void SetFalloffToSquareRoot() { this->SetFalloff(3); }
  const char* GetFalloffAsString();
  ///@}

  ///@{
  /**
   * Radiance of rays that hit nothing. Used for irradiance. Range: >= 0 per channel. Default: 1, 1,
   * 1.
   */
  vtkSetVector3Macro(EnvironmentColor, double);
  vtkGetVector3Macro(EnvironmentColor, double);
  ///@}

  ///@{
  /** Environment map, which replaces EnvironmentColor. Used for irradiance. Default: none. */
  virtual void SetEnvironment(vtkPenumbraEnvironment* environment);
  vtkPenumbraEnvironment* GetEnvironment();
  ///@}

  ///@{
  /** Fraction of light that surfaces reflect. Used for irradiance. Range: [0, 1]. Default: 0.5. */
  vtkSetClampMacro(Albedo, double, 0.0, 1.0);
  vtkGetMacro(Albedo, double);
  ///@}

  ///@{
  /**
   * Number of reflections including the one toward the camera; 1 is direct light. Used for
   * irradiance. Range: [1, 64]. Default: 3.
   */
  vtkSetClampMacro(Bounces, int, 1, 64);
  vtkGetMacro(Bounces, int);
  ///@}

  /**
   * Add a light at the homogeneous world position (x, y, z, w); w = 0: a directional light that
   * comes from the direction (x, y, z). Used for direct light, which is the sum over all lights.
   * All have the intensity 1 and no attenuation. A position that is not finite, a negative w and
   * the direction 0 are errors of the execution, and so is direct light without lights.
   */
  void AddLight(double x, double y, double z, double w);
  void RemoveAllLights();
  int GetNumberOfLights() { return static_cast<int>(this->Lights.size()); }

  ///@{
  /**
   * Radius of positional lights, which are spheres, in world units. The visible fraction is that of
   * vtkPenumbraRayCaster: in solid angle, above the horizon of the normal; the cosine is that to
   * the center of the light. Points inside a light are not shadowed; a warning names the light.
   * Used for direct light. Range: >= 0, finite. Default: 0, hard shadows.
   */
  vtkSetMacro(LightRadius, double);
  vtkGetMacro(LightRadius, double);
  ///@}

  ///@{
  /**
   * Angular diameter of directional lights in degrees; that of the sun is 0.53. Used for direct
   * light. Range: [0, 180]. Default: 0, hard shadows.
   */
  vtkSetMacro(LightAngle, double);
  vtkGetMacro(LightAngle, double);
  ///@}

  ///@{
  /**
   * If on, bake at cell centers, using cell normals, instead of at points. A cell of a volume gets
   * the mean over those of its faces that are on the surface, a triangle strip that of its triangles,
   * weighted by area. Default: off.
   */
  vtkSetMacro(OnCells, bool);
  vtkGetMacro(OnCells, bool);
  vtkBooleanMacro(OnCells, bool);
  ///@}

  ///@{
  /** If on, compute normals even if the input has normals. Default: off. */
  vtkSetMacro(ComputeNormals, bool);
  vtkGetMacro(ComputeNormals, bool);
  vtkBooleanMacro(ComputeNormals, bool);
  ///@}

  ///@{
  /**
   * Radius of the disks that represent the points of an input without polygons, in world units. The
   * points need normals. The vertices of an input with polygons and of the surroundings become
   * spheres of this radius, which occlude. Range: >= 0. Default: 0, no disks and spheres.
   */
  vtkSetClampMacro(PointRadius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(PointRadius, double);
  ///@}

  ///@{
  /**
   * Radius of tubes along the lines of the input and of the surroundings, in world units. Tubes
   * occlude; no values are computed on them. Range: >= 0. Default: 0, lines do not occlude.
   */
  vtkSetClampMacro(LineRadius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(LineRadius, double);
  ///@}

  ///@{
  /**
   * Name of a point array with the opacity of the surface, in [0, 1]: a surface of opacity a
   * occludes the fraction a. On input port 1, the array is optional. Default: none, opaque.
   */
  vtkSetStringMacro(OpacityArray);
  vtkGetStringMacro(OpacityArray);
  ///@}

  /** Methods of computing values. */
  enum Methods
  {
    AUTOMATIC,  ///< interpolate between records if this is faster, else trace rays
    BRUTE_FORCE ///< trace rays at every point, for comparison
  };
  ///@{
  /** Method of computing values. Default: AUTOMATIC. */
  vtkSetClampMacro(Method, int, AUTOMATIC, BRUTE_FORCE);
  vtkGetMacro(Method, int);
  void SetMethodToAutomatic() { this->SetMethod(AUTOMATIC); }
  void SetMethodToBruteForce() { this->SetMethod(BRUTE_FORCE); }
  const char* GetMethodAsString();
  ///@}

  ///@{
  /**
   * Gatherer that samples the hemispheres of records and, for irradiance, of points without a valid
   * record. Default: none, which uses rays.
   */
  virtual void SetGatherer(vtkPenumbraGatherer* gatherer);
  vtkPenumbraGatherer* GetGatherer();
  ///@}

  ///@{
  /** Number of threads; 0 uses all. Values do not depend on it. Range: [0, 1024]. Default: 0. */
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  /**
   * Statistics of the last execution, one value per array: `Points/Total`, `Points/Interpolated`,
   * `Points/Denoised` (denoised), `Points/BruteForce`, `Points/Unused`, `Points/NotFinite`
   * (`Cells/...` if OnCells is on), `Cache/Records`, `Cache/Bytes`, `Rays/Gather`,
   * `Rays/Occlusion`, `Rays/Indirect` or `Rays/Shadow`, `Rays/Total`. Also added to the field data
   * of the output.
   */
  vtkFieldData* GetStatistics();

  /** Includes the modification times of the environment and of the gatherer. */
  vtkMTimeType GetMTime() override;

  /** Estimated RMS error over all points. NaN before the first execution. */
  vtkGetMacro(EstimatedError, double);

protected:
  vtkPenumbraIrradianceFilter();
  ~vtkPenumbraIrradianceFilter() override;

  /// Sets the other ranks that have parts of the data; null: none.
  void SetDistribution(penumbra::OccluderDistribution* distribution);

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkPenumbraIrradianceFilter(const vtkPenumbraIrradianceFilter&) = delete;
  void operator=(const vtkPenumbraIrradianceFilter&) = delete;

  struct Work;
  void Execute(vtkInformationVector** inputs, vtkInformationVector* outputs);
  std::vector<std::string> BakeOnto(
    vtkPointSet* input, vtkPolyData* surroundings, vtkPointSet* output);
  bool BakeOcclusion(Work& work);
  bool BakeIrradiance(Work& work);
  std::vector<std::pair<std::string, std::string>> ListSettings(); ///< that ranks must agree on
  void Warn(const std::vector<std::string>& sentences);
  double ComputeRadius(const Work& work) const; ///< of occlusion, world units
  void Exchange(Work& work);                    ///< with other ranks
  void Report(const Work& work, vtkIdType size);

  double Tolerance = 0.01;
  int Quantity = AMBIENT_OCCLUSION;
  double EnvironmentColor[3] = { 1.0, 1.0, 1.0 };
  double Albedo = 0.5;
  int Bounces = 3;
  double Radius = 0.0;
  int Falloff = 0;
  std::vector<std::array<double, 4>> Lights;
  double LightRadius = 0.0;
  double LightAngle = 0.0;
  bool OnCells = false;
  bool ComputeNormals = false;
  double PointRadius = 0.0;
  double LineRadius = 0.0;
  char* OpacityArray = nullptr;
  int Method = AUTOMATIC;
  int NumberOfThreads = 0;
  vtkSmartPointer<vtkPenumbraEnvironment> Environment;
  vtkSmartPointer<vtkPenumbraGatherer> Gatherer;
  vtkSmartPointer<vtkFieldData> Statistics;
  double EstimatedError;
  penumbra::OccluderDistribution* Distribution = nullptr;
};

#endif
