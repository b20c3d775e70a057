// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The scene and the image of the ray caster, distributed over the ranks of a controller.
#ifndef penumbra_DistributedScene_h
#define penumbra_DistributedScene_h

#include "Distribution/SceneDistribution.h"
#include "Messages/RankGroup.h"
#include "SurfaceExchange.h"
#include "UnitSelection.h"

#include <functional>
#include <string>
#include <vector>

namespace penumbra
{

class ImageDivision;

class DistributedScene final : public SceneDistribution
{
public:
  /// `warn` is called on the first rank if the whole scene must be sent to every rank.
  DistributedScene(
    vtkMultiProcessController* controller, std::function<void(const std::string&)> warn);

  RankAgreement& GetRanks() override { return this->Ranks; }
  void UniteExtent(double bounds[6], double& radius) override;
  void Exchange(Scene& scene, LightRays lightRays) override;
  const std::vector<RegionBounds>& GetRegions() const override { return this->Regions; }
  void Compose(const std::vector<vtkSmartPointer<vtkImageData>>& parts, vtkImageData* image,
    ImageTotals& totals) override;
  void Deliver(const int extent[6], vtkImageData* image) override;

  const ExchangeCounts& GetCounts() const { return this->Counts; }

private:
  /// Returns the units of each surface of this rank that each rank needs, unless for LightRays::All. `bounds`
  /// are those of the whole scene.
  std::vector<std::vector<Units>> Select(const Scene& scene, const ImageDivision& division,
    LightRays lightRays, const AxisAlignedBox& bounds);

  RankGroup Ranks;
  std::function<void(const std::string&)> Warn;
  std::vector<RegionBounds> Regions;
  ExchangeCounts Counts;
};

}
#endif
