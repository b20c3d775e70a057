// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraIrradianceCache
 * @brief   Irradiance cache: occlusion and irradiance gathered at few points and interpolated [IC].
 *
 * Set with vtkPenumbraRayCaster::SetIrradianceProvider(). A record stores a gathered mean and its
 * gradients. The radius of a record follows from its second derivative, so that Tolerance bounds
 * the error of the result. Points without a valid record are computed by brute force.
 *
 * Light of several reflections uses a separate set of records per reflection. The records of the
 * first reflection lie at the hits of rays from visible points; the records of each further
 * reflection look up those of the previous one.
 *
 * The set of records depends on the scene, the camera and the image size. It does not depend on the
 * order of queries, the number of threads or the tiles. Only the order LAZY does not guarantee
 * this.
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
   * Accepted error: RMSE of occlusion, or of irradiance over pi, over 16 x 16 pixels. Range: [1e-4,
   * 1]. 0 uses half of the tolerance passed to Begin(), because errors of neighboring pixels are
   * correlated and do not average out. Default: 0.
   */
  vtkSetClampMacro(Tolerance, double, 0.0, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  /** The two caches of [IC]. */
  enum Spaces
  {
    WORLD, ///< any point can be looked up; fewest records; reusable for other views
    SCREEN ///< only visible points can be looked up; records at the corners of image squares
  };
  ///@{
  /**
   * Space in which records are looked up. All reflections but the last use world space. Default:
   * WORLD.
   */
  vtkSetClampMacro(Space, int, WORLD, SCREEN);
  vtkGetMacro(Space, int);
  void SetSpaceToWorld() { this->SetSpace(WORLD); }
  void SetSpaceToScreen() { this->SetSpace(SCREEN); }
  const char* GetSpaceAsString();
  ///@}

  /** Rules for the radius of a record. */
  enum RadiusRules
  {
    NEAREST_HIT,      ///< [IC]: a fraction of the distance of the nearest hit, without grazing rays
    HARMONIC_MEAN,    ///< [IC]: a fraction of the harmonic mean of all hit distances
    OCCLUSION_HESSIAN ///< from the second derivative and the tolerance
  };
  ///@{
  /** Rule for the radius of a record. Default: OCCLUSION_HESSIAN. */
  vtkSetClampMacro(RadiusRule, int, NEAREST_HIT, OCCLUSION_HESSIAN);
  vtkGetMacro(RadiusRule, int);
  void SetRadiusRuleToNearestHit() { this->SetRadiusRule(NEAREST_HIT); }
  void SetRadiusRuleToHarmonicMean() { this->SetRadiusRule(HARMONIC_MEAN); }
  void SetRadiusRuleToOcclusionHessian() { this->SetRadiusRule(OCCLUSION_HESSIAN); }
  const char* GetRadiusRuleAsString();
  ///@}

  ///@{
  /**
   * Minimum and maximum radius of a record in pixels [IC]. In screen space, rounded down to powers
   * of two, they are also the minimum and maximum side of a square. Ranges: [1, 64] and [4, 1000].
   * Default: 3 and 64.
   */
  vtkSetClampMacro(MinimumRadius, double, 1.0, 64.0);
  vtkGetMacro(MinimumRadius, double);
  vtkSetClampMacro(MaximumRadius, double, 4.0, 1000.0);
  vtkGetMacro(MaximumRadius, double);
  ///@}

  ///@{
  /**
   * Maximum angle in degrees between the normals of a record and of a point that uses it. Range:
   * [0, 90]. 0 computes it from the tolerance (11.5 at 0.005); the formula of [IC] gives 9.
   * Default: 0.
   */
  vtkSetClampMacro(NormalAngle, double, 0.0, 90.0);
  vtkGetMacro(NormalAngle, double);
  ///@}

  ///@{
  /**
   * Number of rays per record, rounded to the square of a multiple of 4. A record that finds no
   * change with a coarse grid uses fewer. Range: [64, 65536]. 0 computes it from the tolerance (at
   * 0.005, 1024 for occlusion and 256 for irradiance, plus supersampling). Default: 0.
   */
  vtkSetClampMacro(RaysPerRecord, int, 0, 65536);
  vtkGetMacro(RaysPerRecord, int);
  ///@}

  ///@{
  /**
   * If on, records are used only for quantities of which they need few, as in rooms and on smooth
   * surfaces, for irradiance of three or more reflections, and not with translucent surfaces. Otherwise
   * images estimate them for all pixels together, as with
   * vtkPenumbraBruteForceIrradiance. Default: off.
   */
  vtkSetMacro(JoinPixels, bool);
  vtkGetMacro(JoinPixels, bool);
  vtkBooleanMacro(JoinPixels, bool);
  ///@}

  /** Times at which records are made. */
  enum Orders
  {
    LEVELS, ///< all records in Begin(), level by level
    LAZY    ///< [IC]: when a query finds no record; the result depends on the order of queries
  };
  ///@{
  /** Time at which records are made. Screen space always uses LEVELS. Default: LEVELS. */
  vtkSetClampMacro(Order, int, LEVELS, LAZY);
  vtkGetMacro(Order, int);
  void SetOrderToLevels() { this->SetOrder(LEVELS); }
  void SetOrderToLazy() { this->SetOrder(LAZY); }
  const char* GetOrderAsString();
  ///@}

  ///@{
  /**
   * Initial records, as returned by GetRecords() or GetIrradianceRecords() for the same scene and
   * the same radius or light. Used in world space only. Default: none.
   */
  virtual void SetInitialRecords(vtkPolyData* records);
  vtkPolyData* GetInitialRecords();
  ///@}

  ///@{
  /**
   * Gatherer that samples the hemispheres of the records. Points without a valid record and all
   * reflections but the last always use rays. Default: none, which uses rays everywhere.
   */
  virtual void SetGatherer(vtkPenumbraGatherer* gatherer);
  vtkPenumbraGatherer* GetGatherer();
  ///@}

  /** Includes the modification times of the gatherer and of the initial records. */
  vtkMTimeType GetMTime() override;

  /**
   * Copies the occlusion records to `records` as points in world coordinates with arrays: normals,
   * `Radius`, ...
   */
  void GetRecords(vtkPolyData* records) const;
  /** Copies the irradiance records of the last reflection to `records`, like GetRecords(). */
  void GetIrradianceRecords(vtkPolyData* records) const;

  bool JoinsPixels(bool occlusion, bool irradiance) const override;

  bool Begin(const penumbra::RayScene& scene, const Occluders& occluders, double tolerance,
    const Progress& progress = {}) override;
  Estimate Occlusion(const double point[3], const double normal[3],
    const double geometricNormal[3] = nullptr) const override;
  /** `tolerance` applies to brute force, which is used for points without a valid record. */
  Estimate OcclusionWithin(const double point[3], const double normal[3], double tolerance,
    const double geometricNormal[3] = nullptr) const override;

  bool BeginIrradiance(
    const penumbra::Illumination& light, double tolerance, const Progress& progress = {}) override;
  /** Gathers at the point itself if it has no valid record. */
  Light Irradiance(const double point[3], const double normal[3], double tolerance,
    const double geometricNormal[3] = nullptr) const override;

  /** Adds `Cache/Records`, `Cache/Bytes`, `Rays/Gather`, and the statistics of the gatherer. */
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
  bool JoinPixels = false;
};

#endif
