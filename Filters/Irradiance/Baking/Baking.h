// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Baking of many query points. Adds records from coarse to fine as long as they are cheaper than
// rays and interpolates between them. The remaining points get low-sample estimates, which a local
// regression denoises. Points with a poor fit are computed by brute force.
#ifndef penumbra_Baking_h
#define penumbra_Baking_h

#include "BakeInput.h"
#include "Execution/ParallelFor.h"
#include "Gathering/IrradianceConstants.h"
#include "Records/RecordPlacement.h"

#include <functional>
#include <vector>

namespace penumbra
{

class RayScene;

/// Mean over the hemisphere at one point, and its standard error.
struct BakedValue
{
  glm::vec3 Mean{ 0.f };
  float Error = 0.f;
};

/// Computes a value without records. Adds the number of rays traced to `rays`.
using PointEstimator = std::function<BakedValue(const RecordCandidate& site, long long& rays)>;

/// Estimators for points without a record.
struct PointEstimators
{
  PointEstimator BruteForce;
  PointEstimator LowSample;   ///< uses few rays, one channel; if empty, all points use BruteForce
  float LowSampleError = 0.f; ///< accepted RMS error of denoised values
  float RegressionRadius = penumbra::RegressionRadius; ///< of the denoising fit, in spacings
};

/// How a value was computed, the most expensive method last.
enum class BakingMethod : unsigned char
{
  Interpolated, ///< between records, or of a record at the point
  Denoised,     ///< a low-sample estimate
  BruteForce
};

struct BakedValues
{
  std::vector<BakedValue> Values;    ///< one per query point
  std::vector<BakingMethod> Methods; ///< one per query point
  long long BruteForceRays = 0;
  long long GatherRays = 0; ///< rays of records
};

/**
 * Computes the values at the query points of `mesh`. `rays` are of its occluders. If `records` is
 * false, only brute force is used. Returns false or throws Stopped if `progress` requested a stop.
 */
bool Bake(const BakeInput& mesh, const RayScene& rays, bool records, RecordPlacement& placement,
  const RecordOctree& tree, const PointEstimators& estimators, const ProgressCallback& progress,
  BakedValues& result);

}
#endif
