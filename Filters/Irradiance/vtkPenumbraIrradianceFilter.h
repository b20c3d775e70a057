// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraIrradianceFilter
 * @brief   Bakes ambient occlusion or irradiance onto a mesh: a point or cell array, to a tolerance.
 *
 * Adds the array `AmbientOcclusion` (0 open, 1 blocked) or `Irradiance` (red, green and blue; pi under a
 * white sky) to a copy of the input: any vtkPointSet with
 * a surface, or points alone with PointRadius. The hemisphere of a point is about its normal, as the
 * file has it, or as computed from the polygons; surfaces block from both sides. The blocks of a
 * composite data set are one scene: each may block all others. What else is there, but gets no values,
 * such as the floor below or the pieces of other processes, goes to input port 1 (optional, vtkPolyData):
 * its polygons block, and throw light back.
 *
 * Values are interpolated between the records of a cache as long as that is cheaper than rays at
 * every point, which it finds out by itself; of occlusion, few rays at every other point, made certain by
 * its neighbours, and more where these do not agree. Points of no cell and points that are not finite get 0
 * and are counted. When aborted, the output is the input without the array.
 */
#ifndef vtkPenumbraIrradianceFilter_h
#define vtkPenumbraIrradianceFilter_h

#include "vtkPassInputTypeAlgorithm.h"
#include "vtkPenumbraFiltersIrradianceModule.h" // for export macro
#include "vtkSmartPointer.h"                    // for members

class vtkFieldData;
class vtkPenumbraEnvironment;
class vtkPenumbraGatherer;
class vtkPointSet;
class vtkPolyData;

class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT vtkPenumbraIrradianceFilter
  : public vtkPassInputTypeAlgorithm
{
public:
  static vtkPenumbraIrradianceFilter* New();
  vtkTypeMacro(vtkPenumbraIrradianceFilter, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** What is baked. */
  enum Quantities
  {
    AMBIENT_OCCLUSION, ///< the blocked share of the sky within Radius
    IRRADIANCE         ///< light from the environment, straight and from surface to surface
  };
  ///@{
  /** What is baked. Default: AMBIENT_OCCLUSION. */
  vtkSetClampMacro(Quantity, int, AMBIENT_OCCLUSION, IRRADIANCE);
  vtkGetMacro(Quantity, int);
  ///@}

  ///@{
  /** Error accepted: the RMSE over all points, in the array's unit, 1e-4 to 1. Default: 0.01. */
  vtkSetClampMacro(Tolerance, double, 1e-4, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /** Reach of an occluder in world units, may be infinite; 0: a tenth of the diagonal of all bounds. Default: 0. */
  vtkSetClampMacro(Radius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /** How an occluder counts less with its distance: one of vtkPenumbraIrradianceProvider::Falloffs. Default: NO_FALLOFF. */
  vtkSetClampMacro(Falloff, int, 0, 3);
  vtkGetMacro(Falloff, int);
  ///@}

  ///@{
  /** Irradiance: radiance that comes from where nothing is, 0 up. Default: 1, 1, 1. */
  vtkSetVector3Macro(EnvironmentColor, double);
  vtkGetVector3Macro(EnvironmentColor, double);
  ///@}

  ///@{
  /** Irradiance: a picture of the environment, instead of EnvironmentColor. Default: none. */
  virtual void SetEnvironment(vtkPenumbraEnvironment* environment);
  vtkPenumbraEnvironment* GetEnvironment();
  ///@}

  ///@{
  /** Irradiance: share of light that the surface throws back, in [0, 1]. Default: 0.5. */
  vtkSetClampMacro(Albedo, double, 0.0, 1.0);
  vtkGetMacro(Albedo, double);
  ///@}

  ///@{
  /** Irradiance: reflections up to the eye's, which is the last, 1 to 64; 1: straight light. Default: 3. */
  vtkSetClampMacro(Bounces, int, 1, 64);
  vtkGetMacro(Bounces, int);
  ///@}

  ///@{
  /** Bake at the centres of cells, about their own normals, not at points. A cell of a volume has the mean
   * of those of its faces that are on the surface. Default: off. */
  vtkSetMacro(OnCells, bool);
  vtkGetMacro(OnCells, bool);
  vtkBooleanMacro(OnCells, bool);
  ///@}

  ///@{
  /** Compute normals even where the input has some. Default: off. */
  vtkSetMacro(ComputeNormals, bool);
  vtkGetMacro(ComputeNormals, bool);
  vtkBooleanMacro(ComputeNormals, bool);
  ///@}

  ///@{
  /** Radius of the discs that stand for points where there are no polygons, world units; they need normals. Default: 0, none. */
  vtkSetClampMacro(PointRadius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(PointRadius, double);
  ///@}

  /** How values are found. */
  enum Methods
  {
    AUTOMATIC,  ///< by records where they pay, else by rays
    BRUTE_FORCE ///< by rays at every point, for comparison
  };
  ///@{
  /** How values are found. Default: AUTOMATIC. */
  vtkSetClampMacro(Method, int, AUTOMATIC, BRUTE_FORCE);
  vtkGetMacro(Method, int);
  ///@}

  ///@{
  /** Looks around from records, and for irradiance from points that none serves; else rays do. Default: none, rays. */
  virtual void SetGatherer(vtkPenumbraGatherer* gatherer);
  vtkPenumbraGatherer* GetGatherer();
  ///@}

  ///@{
  /** Threads, 0: all. The values do not depend on it. Default: 0. */
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  /**
   * Counts of the last execution, one value an array: `Points/Total`, `Points/Interpolated`,
   * `Points/Denoised`, `Points/BruteForce`, `Points/Unused`, `Points/NotFinite` (cells likewise), `Cache/Records`,
   * `Cache/Bytes`, `Rays/Gather`, `Rays/Occlusion`, `Rays/Total`. Also in the output's field data.
   */
  vtkFieldData* GetStatistics();

  /** Also those of environment and gatherer. */
  vtkMTimeType GetMTime() override;

  /** RMS over all points of the error that the algorithm believes it made. NaN before it ran. */
  vtkGetMacro(EstimatedError, double);

protected:
  vtkPenumbraIrradianceFilter();
  ~vtkPenumbraIrradianceFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkPenumbraIrradianceFilter(const vtkPenumbraIrradianceFilter&) = delete;
  void operator=(const vtkPenumbraIrradianceFilter&) = delete;

  struct Work;
  void Execute(vtkInformationVector** inputs, vtkInformationVector* outputs);
  void BakeOnto(vtkPointSet* input, vtkPolyData* surroundings, vtkPointSet* output);
  bool BakeOcclusion(Work& work);
  bool BakeIrradiance(Work& work);
  void Report(const Work& work, vtkIdType size);

  double Tolerance = 0.01;
  int Quantity = AMBIENT_OCCLUSION;
  double EnvironmentColor[3] = { 1.0, 1.0, 1.0 };
  double Albedo = 0.5;
  int Bounces = 3;
  double Radius = 0.0;
  int Falloff = 0;
  bool OnCells = false;
  bool ComputeNormals = false;
  double PointRadius = 0.0;
  int Method = AUTOMATIC;
  int NumberOfThreads = 0;
  vtkSmartPointer<vtkPenumbraEnvironment> Environment;
  vtkSmartPointer<vtkPenumbraGatherer> Gatherer;
  vtkSmartPointer<vtkFieldData> Statistics;
  double EstimatedError;
};

#endif
