// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraBruteForceIrradiance
 * @brief   Occlusion and irradiance by rays alone: no cache, no bias, the truth for every other source.
 *
 * Rays follow a scrambled low-discrepancy sequence that is a function of the point alone. Their
 * number is doubled until the error is within the tolerance or MaximumRays is reached. The error is
 * told by the pairs of rays that share a cell of the hemisphere: where an occluder's border passes
 * through the cell, they differ. For irradiance every ray becomes a path.
 */
#ifndef vtkPenumbraBruteForceSource_h
#define vtkPenumbraBruteForceSource_h

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
  /** No more rays than this (of irradiance: paths) for one point, 32 to 2^24. Default: 16384. */
  vtkSetClampMacro(MaximumRays, int, 32, 1 << 24);
  vtkGetMacro(MaximumRays, int);
  ///@}

  ///@{
  /** Rays of the first round, a power of two, 8 to 65536, for irradiance eight times as many, but never
   * more than MaximumRays: what hides from them goes unseen. Default: 32. */
  vtkSetClampMacro(MinimumRays, int, 8, 65536);
  vtkGetMacro(MinimumRays, int);
  ///@}

  bool Begin(const penumbra::RayScene& scene, const Occluders& occluders, double tolerance,
    const Progress& progress = {}) override;
  Estimate Occlusion(const double point[3], const double normal[3]) const override;
  Estimate OcclusionWithin(
    const double point[3], const double normal[3], double tolerance) const override;

  bool BeginIrradiance(
    const penumbra::Illumination& light, double tolerance, const Progress& progress = {}) override;
  Light Irradiance(const double point[3], const double normal[3], double tolerance) const override;

protected:
  vtkPenumbraBruteForceIrradiance();
  ~vtkPenumbraBruteForceIrradiance() override;

private:
  vtkPenumbraBruteForceIrradiance(const vtkPenumbraBruteForceIrradiance&) = delete;
  void operator=(const vtkPenumbraBruteForceIrradiance&) = delete;

  const penumbra::RayScene* Rays = nullptr;
  Occluders Counting = 0.0;
  double Tolerance = 0.01;
  int MaximumRays = 16384;
  int MinimumRays = 32;
  std::unique_ptr<penumbra::Illumination> Lighting;
};

#endif
