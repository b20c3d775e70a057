// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Records of one view, made level by level over its pixels or lazily by queries, and looked up in
// world space or in screen space.
#ifndef penumbra_ViewRecords_h
#define penumbra_ViewRecords_h

#include "ScreenSpaceRecords.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace penumbra
{

class RayScene;

class ViewRecords
{
public:
  /// `rays` and `gatherer` must outlive this object. If `onScreen` is true, uses the screen-space
  /// cache and ignores the `initial` records.
  ViewRecords(const RayScene& rays, const Gatherer& gatherer,
    const RecordPlacementSettings& settings, float normalAngle, bool onScreen,
    const std::vector<Record>& initial);

  /// Makes all records of the image. Returns false if `progress` requested a stop.
  bool PlaceLevels(const ProgressCallback& progress);

  InterpolationResult LookUp(const ShadingPoint& point) const
  {
    return this->Screen ? this->Screen->LookUp(point) : this->Tree.LookUp(point);
  }

  /// Looks up `point` in world space and makes a record there if none is valid [IC].
  InterpolationResult LookUpOrGather(const ShadingPoint& point);

  /// Gathers at `point` without records, to an error of about `tolerance` in every channel. Adds the
  /// number of rays to `rays`.
  InterpolationResult Gather(const ShadingPoint& point, double tolerance, long long& rays) const;

  const std::vector<Record>& GetRecords() const
  {
    return this->Screen ? this->Screen->GetRecords() : this->Tree.GetRecords();
  }
  float GetNormalAngle() const { return this->Tree.GetNormalAngle(); }
  std::size_t GetBytes() const
  {
    return this->Screen ? this->Screen->GetBytes() : this->Tree.GetBytes();
  }
  long long GetRays() const
  {
    return this->Screen ? this->Screen->GetRays() : this->Placement.GetRays() + this->LazyRays;
  }

private:
  float PixelAt(glm::vec3 position) const;
  InterpolationResult GatherWithRays(
    const ShadingPoint& point, std::uint32_t count, long long& rays) const;

  const RayScene& Rays;
  const Gatherer& Source;
  double Radiance; ///< of the light sources
  RecordOctree Tree;
  RecordPlacement Placement;
  std::unique_ptr<ScreenSpaceRecords> Screen; ///< null in world space
  std::mutex Lock;                            ///< guards Tree and LazyRays in LookUpOrGather()
  long long LazyRays = 0;
};

}
#endif
