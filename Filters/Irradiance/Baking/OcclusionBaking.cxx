// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionBaking.h"

#include "Embree/RayScene.h"

#include "vtkNew.h"
#include "vtkPenumbraBruteForceIrradiance.h"

#include <algorithm>

namespace penumbra
{
namespace
{

/// Calls `estimate(position, normal)`, in world units, at a query point.
template <typename Estimate>
BakedValue EstimateAt(
  const Scene& scene, const RecordCandidate& site, const Estimate& estimate, long long& rays)
{
  const glm::dvec3 world = scene.ToWorld(site.Position);
  const glm::dvec3 normal(site.Normal);
  const glm::dvec3 geometricNormal(site.GetNormals().Geometric);
  const auto found = estimate(&world.x, &normal.x, &geometricNormal.x);
  rays += found.Rays;
  return { glm::vec3(static_cast<float>(found.Value)), static_cast<float>(found.Error) };
}

}

bool BakeOcclusion(const BakeInput& mesh, const RayScene& rays, const Gatherer& gatherer,
  const OcclusionBakingSettings& settings, const OcclusionBakingConstants& constants,
  RecordOctree& tree, const ProgressCallback& progress, BakedValues& result)
{
  const Scene& scene = mesh.OccluderScene;
  const double tolerance = settings.Tolerance;
  RecordPlacementSettings records;
  records.MaximumRadiusPixels = MaximumRadiusPixels;
  records.Tolerance = HessianErrorFraction * tolerance;
  records.Side = RecordPlacement::ComputeSide(RecordNoiseFactor * tolerance);
  tree.SetNormalAngle(RecordPlacement::ComputeNormalAngle(RotationErrorFraction * tolerance));
  RecordPlacement placement(gatherer, records, tree);

  vtkNew<vtkPenumbraBruteForceIrradiance> provider;
  provider->SetMinimumRays(MinimumRays);
  provider->Begin(rays, settings.Occluders, constants.BruteForceErrorFactor * tolerance);
  // A tolerance of 0 disables adaptive sampling: the noise alone sets the number of rays.
  vtkNew<vtkPenumbraBruteForceIrradiance> lowSampleProvider;
  lowSampleProvider->Begin(rays, settings.Occluders, 0.0);
  const double noise = std::min(constants.LowSampleNoiseFactor * tolerance, MaximumLowSampleNoise);
  const PointEstimators estimators{ [&](const RecordCandidate& site, long long& count) {
                                     return EstimateAt(
                                       scene, site,
                                       [&](const double* x, const double* n, const double* g) {
                                         return provider->Occlusion(x, n, g);
                                       },
                                       count);
                                   },
    [&](const RecordCandidate& site, long long& count) {
      return EstimateAt(
        scene, site,
        [&](const double* x, const double* n, const double* g) {
          return lowSampleProvider->OcclusionWithin(x, n, noise, g);
        },
        count);
    },
    static_cast<float>(constants.DenoisedErrorFactor * tolerance),
    static_cast<float>(constants.RegressionRadius) };
  const bool done =
    Bake(mesh, rays, settings.UsesRecords, placement, tree, estimators, progress, result);
  for (BakedValue& value : result.Values)
  {
    value.Mean = glm::clamp(value.Mean, 0.f, 1.f);
  }
  result.GatherRays = placement.GetRays();
  return done;
}

}
