// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraBruteForceIrradiance
 * @brief   Unbiased ambient occlusion and irradiance by ray tracing, without a cache.
 *
 * Other irradiance providers are compared with this class. Rays follow a scrambled low-discrepancy
 * sequence whose seed depends only on the point and its normal. The number of rays is doubled until
 * the estimated error is within the tolerance or MaximumRays is reached. The error is estimated
 * from pairs of rays that share a cell of the hemisphere: they differ if the edge of an occluder
 * passes through the cell. For irradiance, each ray is the start of a path.
 */
#ifndef vtkPenumbraBruteForceIrradiance_h
#define vtkPenumbraBruteForceIrradiance_h

#include "vtkPenumbraIrradianceProvider.h"

#include <memory> // for std::unique_ptr

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT vtkPenumbraBruteForceIrradiance
  : public vtkPenumbraIrradianceProvider
{
public:
  static vtkPenumbraBruteForceIrradiance* New();
  vtkTypeMacro(vtkPenumbraBruteForceIrradiance, vtkPenumbraIrradianceProvider);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Maximum number of rays (irradiance: paths) per point. Range: [32, 2^24]. Default: 16384. */
  vtkSetClampMacro(MaximumRays, int, 32, 1 << 24);
  vtkGetMacro(MaximumRays, int);
  ///@}

  ///@{
  /**
   * Number of rays per point in the first round, rounded up to a power of two. Irradiance starts
   * with eight times this number of paths. Neither exceeds MaximumRays. Occluders that all these
   * rays miss are not detected. Range: [8, 65536]. Default: 32.
   */
  vtkSetClampMacro(MinimumRays, int, 8, 65536);
  vtkGetMacro(MinimumRays, int);
  ///@}

  bool Begin(const penumbra::RayScene& scene, const Occluders& occluders, double tolerance,
    const Progress& progress = {}) override;
  Estimate Occlusion(const double point[3], const double normal[3],
    const double geometricNormal[3] = nullptr) const override;
  Estimate OcclusionWithin(const double point[3], const double normal[3], double tolerance,
    const double geometricNormal[3] = nullptr) const override;

  /** Returns JoinPixels. */
  bool JoinsPixels(bool vtkNotUsed(occlusion), bool vtkNotUsed(irradiance)) const override
  {
    return this->JoinPixels;
  }

  ///@{
  /**
   * If on, images estimate their ambient occlusion and indirect light for all pixels together, which takes
   * far fewer rays. If off, each point is estimated alone. Default: on.
   */
  vtkSetMacro(JoinPixels, bool);
  vtkGetMacro(JoinPixels, bool);
  vtkBooleanMacro(JoinPixels, bool);
  ///@}

  bool BeginIrradiance(
    const penumbra::Illumination& light, double tolerance, const Progress& progress = {}) override;
  Light Irradiance(const double point[3], const double normal[3], double tolerance,
    const double geometricNormal[3] = nullptr) const override;

protected:
  vtkPenumbraBruteForceIrradiance();
  ~vtkPenumbraBruteForceIrradiance() override;

private:
  vtkPenumbraBruteForceIrradiance(const vtkPenumbraBruteForceIrradiance&) = delete;
  void operator=(const vtkPenumbraBruteForceIrradiance&) = delete;

  const penumbra::RayScene* Rays = nullptr;
  Occluders OccluderSettings = 0.0;
  double Tolerance = 0.01;           ///< of occlusion, passed to Begin()
  double IrradianceTolerance = 0.01; ///< passed to BeginIrradiance()
  bool Translucent = false;          ///< the scene has translucent occluders
  bool JoinPixels = true;
  int MaximumRays = 16384;
  int MinimumRays = 32;
  std::unique_ptr<penumbra::Illumination> Lighting;
};

#endif
