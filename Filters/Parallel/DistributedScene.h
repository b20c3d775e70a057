// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The scene and the image of the ray caster, distributed over the ranks of a controller.
#ifndef penumbra_DistributedScene_h
#define penumbra_DistributedScene_h

#include "Distribution/SceneDistribution.h"
#include "RankGroup.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace penumbra
{

class ImageDivision;
struct AxisAlignedBox;

/// What the ranks have exchanged for an image.
struct ExchangeCounts
{
  long long SceneBytes = 0;      ///< received by this rank to render its part of the image
  long long WholeBytes = 0;      ///< of all surfaces of all ranks
  long long Primitives = 0;      ///< that this rank has after the exchange
  long long WholePrimitives = 0; ///< of all ranks
  long long PixelBytes = 0;      ///< of parts of the image, received by this rank
  long long Rays = 0;            ///< traced by this rank
};

class DistributedScene final : public SceneDistribution
{
public:
  /// `warn` is called on the first rank if the whole scene must be sent to every rank.
  DistributedScene(
    vtkMultiProcessController* controller, std::function<void(const std::string&)> warn);

  void Compare(const SettingList& settings) override;
  void UniteExtent(double bounds[6], double& radius) override;
  void Exchange(Scene& scene, LightRays lightRays) override;
  const std::vector<RegionBounds>& GetRegions() const override { return this->Regions; }
  void Compose(const std::vector<vtkSmartPointer<vtkImageData>>& parts, vtkImageData* image,
    ImageTotals& totals) override;
  void Deliver(const int extent[6], vtkImageData* image) override;
  bool IsFirst() const override { return this->Ranks.GetRank() == 0; }
  std::string Fail(const std::string& message) override { return this->Ranks.Fail(message); }

  const ExchangeCounts& GetCounts() const { return this->Counts; }

private:
  /// Returns the units of each surface of this rank that each rank needs, unless for LightRays::All. `bounds`
  /// are those of the whole scene.
  std::vector<std::vector<std::vector<std::uint32_t>>> Select(const Scene& scene,
    const ImageDivision& division, LightRays lightRays, const AxisAlignedBox& bounds);
  /// Counts the primitives of this rank and the bytes of all surfaces, of which `bytes` were this rank's.
  void Count(const Scene& scene, long long bytes);

  RankGroup Ranks;
  std::function<void(const std::string&)> Warn;
  std::vector<RegionBounds> Regions;
  ExchangeCounts Counts;
};

}
#endif
