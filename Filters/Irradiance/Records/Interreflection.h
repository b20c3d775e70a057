// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Light of several reflections: one octree of records for each reflection but the last, starting at
// the lights. Rays from the records of one reflection look up the records of the previous one at
// their hits.
#ifndef penumbra_Interreflection_h
#define penumbra_Interreflection_h

#include "Gathering/RayGatherer.h"
#include "RecordPlacement.h"

#include <memory>
#include <vector>

namespace penumbra
{

class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT Interreflection
{
public:
  /// `settings` and `normalAngle` are those of the records that will use GetGatherer().
  Interreflection(
    const Illumination& light, const RecordPlacementSettings& settings, float normalAngle);

  /// Places the records at the hits of rays from some of `imagePoints`, the points of
  /// later queries. Returns false if `progress` requested a stop.
  bool Build(const std::vector<RecordCandidate>& imagePoints, const ProgressCallback& progress);

  /// Returns a gatherer of the light of all reflections but the last; before Build(), of the first
  /// only.
  const LightGatherer& GetGatherer() const { return *this->Gatherers.back(); }

  const Illumination& GetLight() const { return this->Light; }

  long long GetRays() const { return this->Rays; }
  std::size_t GetRecords() const;
  std::size_t GetBytes() const;

private:
  std::vector<RecordCandidate> FindSites(
    const std::vector<RecordCandidate>& imagePoints, const ProgressCallback& progress);

  Illumination Light;
  RecordPlacementSettings Settings;
  float NormalAngle;
  std::vector<std::unique_ptr<RecordOctree>> Trees;
  std::vector<std::unique_ptr<LightGatherer>> Gatherers; ///< of direct light, then one per octree
  long long Rays = 0;
};

}
#endif
