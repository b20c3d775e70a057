// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Values at many places at once: records from coarse to fine as long as they pay, interpolation; for
// what is left few rays everywhere, made certain by neighbours; brute force where these do not agree.
#ifndef penumbra_Baking_h
#define penumbra_Baking_h

#include "Execution/ParallelFor.h"
#include "Records/RecordPlacement.h"

#include <functional>
#include <vector>

namespace penumbra
{

/// The mean over the hemisphere at one place, and its standard error.
struct BakedValue
{
  glm::vec3 Mean{ 0.f };
  float Error = 0.f;
};

/// Answers without records; adds the rays traced to its argument.
using BruteForceAnswer = std::function<BakedValue(const RecordCandidate& site, long long& rays)>;

/// How places without a record are answered.
struct PointEstimators
{
  BruteForceAnswer BruteForce;
  BruteForceAnswer LowSample; ///< with few rays, one channel; none: brute force for all
  float LowSampleError = 0.f; ///< RMS error of values that neighbours have made certain
};

struct BakedValues
{
  std::vector<BakedValue> Values; ///< one for each site
  std::size_t Interpolated = 0;
  std::size_t Denoised = 0;   ///< made certain by neighbours
  std::size_t BruteForce = 0; ///< the rest are places of records that serve nobody else
  long long BruteForceRays = 0;
};

/**
 * Sites' Pixel is their distance from neighbours. `records`: false leaves them out. False, or
 * Stopped is thrown, when `progress` stopped it.
 */
bool Bake(const std::vector<RecordCandidate>& sites, float spacing, bool records,
  RecordPlacement& places, const RecordOctree& tree, const PointEstimators& answers,
  const ProgressCallback& progress, BakedValues& result);

}
#endif
