// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraIrradianceCache
 * @brief   Occlusion and irradiance gathered at few points and interpolated between them [IC].
 *
 * Give it to vtkPenumbraRayCaster::SetIrradianceSource(). Records hold what was gathered with its
 * gradients; how far a record serves follows from its second derivative, so that Tolerance is an
 * error of the result. Where no record serves, brute force answers.
 *
 * Light of several reflections has records for each: those of the first lie where rays from the picture
 * end, the next ones look them up.
 *
 * Which records there are is a function of scene, camera and whole picture: never of the order of
 * questions, of threads or of tiles. Only the paper's LAZY order is outside that promise.
 */
#ifndef vtkPenumbraIrradianceCache_h
#define vtkPenumbraIrradianceCache_h

#include "vtkPenumbraFiltersIrradianceModule.h" // for export macro
#include "vtkPenumbraIrradianceProvider.h"

#include <memory> // for std::unique_ptr

class vtkPenumbraGatherer;
class vtkPolyData;

class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT vtkPenumbraIrradianceCache
  : public vtkPenumbraIrradianceProvider
{
public:
  static vtkPenumbraIrradianceCache* New();
  vtkTypeMacro(vtkPenumbraIrradianceCache, vtkPenumbraIrradianceProvider);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Error accepted, as the RMSE of occlusion or of irradiance over pi in 16x16 pixels, 1e-4 to 1; 0:
   * half of what Begin() asks for, since errors of neighbours are alike here and do not average out.
   * Default: 0.
   */
  vtkSetClampMacro(Tolerance, double, 0.0, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  /** The two caches of [IC]. */
  enum Spaces
  {
    WORLD, ///< any place asks; fewest records; they serve other views, too
    SCREEN ///< what the picture sees first; records at the corners of squares of the picture
  };
  ///@{
  /** Where records are looked up. Reflections before the last are looked up in world space. Default: WORLD. */
  vtkSetClampMacro(Space, int, WORLD, SCREEN);
  vtkGetMacro(Space, int);
  ///@}

  /** How far a record serves. */
  enum RadiusRules
  {
    NEAREST_HIT,      ///< [IC]: a share of the distance of the nearest hit, grazing rays left out
    HARMONIC_MEAN,    ///< [IC]: a share of the harmonic mean of all distances
    OCCLUSION_HESSIAN ///< as far as the second derivative keeps the error within the tolerance
  };
  ///@{
  /** How radii are found. Default: OCCLUSION_HESSIAN. */
  vtkSetClampMacro(RadiusRule, int, NEAREST_HIT, OCCLUSION_HESSIAN);
  vtkGetMacro(RadiusRule, int);
  ///@}

  ///@{
  /**
   * Least and greatest radius of a record in pixels of the picture [IC], 1 to 64 and 4 to 1000; in screen
   * space also, rounded down to powers of two, the sides of squares. Default: 3, 64.
   */
  vtkSetClampMacro(MinimumRadius, double, 1.0, 64.0);
  vtkGetMacro(MinimumRadius, double);
  vtkSetClampMacro(MaximumRadius, double, 4.0, 1000.0);
  vtkGetMacro(MaximumRadius, double);
  ///@}

  ///@{
  /** Greatest angle between normals that share a record, degrees, up to 90; 0: from the tolerance (11.5 at .005). [IC]'s formula has 9. Default: 0. */
  vtkSetClampMacro(NormalAngle, double, 0.0, 90.0);
  vtkGetMacro(NormalAngle, double);
  ///@}

  ///@{
  /** Rays of a record where something is seen to change, 64 to 65536, a square; 0: from the tolerance (1024 at .005; of light 324). Default: 0. */
  vtkSetClampMacro(RaysPerRecord, int, 0, 65536);
  vtkGetMacro(RaysPerRecord, int);
  ///@}

  /** When records are made. */
  enum Orders
  {
    LEVELS, ///< all at the beginning, level by level
    LAZY    ///< [IC]'s: where a question finds none; depends on the order of questions
  };
  ///@{
  /** When records are made; in screen space always LEVELS. Default: LEVELS. */
  vtkSetClampMacro(Order, int, LEVELS, LAZY);
  vtkGetMacro(Order, int);
  ///@}

  ///@{
  /**
   * Records to begin with, as GetRecords() or GetIrradianceRecords() gave them for the same scene and
   * reach or light; for world space. Default: none.
   */
  virtual void SetInitialRecords(vtkPolyData* records);
  vtkPolyData* GetInitialRecords();
  ///@}

  ///@{
  /** Looks around from the records. Questions that no record serves, and reflections before the last, are answered by rays. Default: none, rays. */
  virtual void SetGatherer(vtkPenumbraGatherer* gatherer);
  vtkPenumbraGatherer* GetGatherer();
  ///@}

  /** Also that of the gatherer. */
  vtkMTimeType GetMTime() override;

  /** The records as points with arrays, in world coordinates: position, normal, `Radius`, ... */
  void GetRecords(vtkPolyData* records) const;
  /** Those of the last reflection, likewise. */
  void GetIrradianceRecords(vtkPolyData* records) const;

  bool Begin(const penumbra::RayScene& scene, const Occluders& occluders, double tolerance,
    const Progress& progress = {}) override;
  Estimate Occlusion(const double point[3], const double normal[3]) const override;
  /** `tolerance` is for brute force, where no record serves. */
  Estimate OcclusionWithin(
    const double point[3], const double normal[3], double tolerance) const override;

  bool BeginIrradiance(
    const penumbra::Illumination& light, double tolerance, const Progress& progress = {}) override;
  /** Where no record serves, a gather of its own answers. */
  Light Irradiance(const double point[3], const double normal[3], double tolerance) const override;

  /** `Cache/Records`, `Cache/Bytes`, `Rays/Gather`, and what the gatherer counted. */
  void Report(vtkFieldData* statistics) const override;

protected:
  vtkPenumbraIrradianceCache();
  ~vtkPenumbraIrradianceCache() override;

private:
  vtkPenumbraIrradianceCache(const vtkPenumbraIrradianceCache&) = delete;
  void operator=(const vtkPenumbraIrradianceCache&) = delete;

  bool IsLazy() const { return this->Order == LAZY && this->Space == WORLD; }

  struct Internals;
  std::unique_ptr<Internals> Implementation;

  double Tolerance = 0.0;
  int Space = WORLD;
  int RadiusRule = OCCLUSION_HESSIAN;
  double MinimumRadius = 3.0;
  double MaximumRadius = 64.0;
  double NormalAngle = 0.0;
  int RaysPerRecord = 0;
  int Order = LEVELS;
};

#endif
