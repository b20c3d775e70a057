// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Light that is reflected several times: a cache of records for each reflection but the last, made
// from the light's side on. The records of one look up those of the one before where their rays end.
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
  /// `settings` are those of the records that will ask GetGatherer().
  Interreflection(
    const Illumination& light, const RecordPlacementSettings& settings, float normalAngle);

  /// `seen`: places that will ask. The records lie where rays from some of them end. False when
  /// `progress` stopped it.
  bool Build(const std::vector<RecordCandidate>& seen, const ProgressCallback& progress);

  /// Sees light of all reflections but the last. Before Build() that of the first.
  const LightGatherer& GetGatherer() const { return *this->Gatherers.back(); }

  const Illumination& GetLight() const { return this->Light; }

  long long GetRays() const { return this->Rays; }
  std::size_t GetRecords() const;
  std::size_t GetBytes() const;

private:
  std::vector<RecordCandidate> FindSites(
    const std::vector<RecordCandidate>& seen, const ProgressCallback& progress);

  Illumination Light;
  RecordPlacementSettings Settings;
  float NormalAngle;
  std::vector<std::unique_ptr<RecordOctree>> Trees;
  std::vector<std::unique_ptr<LightGatherer>> Gatherers; ///< one more
  long long Rays = 0;
};

}
#endif
