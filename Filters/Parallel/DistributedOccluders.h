// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The occluders of baking, distributed over the ranks of a controller.
#ifndef penumbra_DistributedOccluders_h
#define penumbra_DistributedOccluders_h

#include "AxisAlignedBox.h"
#include "Distribution/OccluderDistribution.h"
#include "Messages/RankGroup.h"
#include "SurfaceExchange.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace penumbra
{

class CellMarks;

class DistributedOccluders final : public OccluderDistribution
{
public:
  /// `warn` is called on the first rank if all surfaces must be sent to every rank.
  DistributedOccluders(
    vtkMultiProcessController* controller, std::function<void(const std::string&)> warn);

  RankAgreement& GetRanks() override { return this->Ranks; }
  std::uint32_t Exchange(
    Scene& scene, const std::vector<glm::vec3>& points, std::optional<double> radius) override;

  const ExchangeCounts& GetCounts() const { return this->Counts; }

private:
  /// `needed` marks what this rank needs, in the bounds of the whole scene.
  std::vector<std::string> ExchangeParts(const Scene& scene,
    const std::vector<UnitedSurface>& united, const AxisAlignedBox& bounds,
    const CellMarks& needed);

  RankGroup Ranks;
  std::function<void(const std::string&)> Warn;
  ExchangeCounts Counts;
};

}
#endif
