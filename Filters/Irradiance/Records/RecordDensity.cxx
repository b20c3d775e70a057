// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RecordDensity.h"

#include "Embree/RayScene.h"
#include "PixelCandidates.h"

namespace penumbra
{
namespace
{

/// Records pay if at most this fraction of the visible points at a stride of DensityStride pixels that no
/// earlier record covers needs one; in proportion to the stride before, if there are MinimumDensityPoints
/// points. Measured with indirect light of three reflections at 500x300: bell jar .02, box .06, bracket .47, head
/// .59, brain and terrain .98.
constexpr int DensityStride = 8;
constexpr double MaximumRecordFraction = 0.15;
constexpr std::size_t MinimumDensityPoints = 32;

}

bool NeedsFewRecords(const RayScene& rays, const Gatherer& gatherer,
  const RecordPlacementSettings& settings, float normalAngle, const ProgressCallback& progress,
  long long& traced)
{
  RecordOctree tree;
  tree.InitializeFromSurfaces(rays.GetSurfaces());
  tree.SetNormalAngle(normalAngle);
  RecordPlacement placement(gatherer, settings, tree);
  std::size_t points = 0;
  std::size_t before = 0; // records of the strides before this one
  bool isDense = false;
  for (int level = 0; LevelStride(level) >= DensityStride && !isDense; ++level)
  {
    const std::vector<RecordCandidate> sites = CandidatesInImage(rays, level, progress);
    if (!placement.AddLevel(sites, progress))
    {
      throw Stopped();
    }
    points += sites.size();
    const int stride = LevelStride(level);
    if (LevelStride(level + 1) < stride)
    {
      const std::size_t records = tree.GetRecords().size();
      isDense = (points >= MinimumDensityPoints || stride == DensityStride) &&
        static_cast<double>(records - before) >=
          MaximumRecordFraction * stride / DensityStride * static_cast<double>(points);
      before = records;
      points = 0;
    }
  }
  traced += placement.GetRays();
  return !isDense;
}

}
