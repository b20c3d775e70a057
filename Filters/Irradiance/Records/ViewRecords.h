// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The records of one picture: made level by level over its pixels, or where a question finds none; looked
// up in space, or in the picture.
#ifndef penumbra_ViewRecords_h
#define penumbra_ViewRecords_h

#include "ScreenSpaceRecords.h"

#include <memory>
#include <mutex>
#include <vector>

namespace penumbra
{

class RayScene;

class ViewRecords
{
public:
  /// `rays` and `gatherer` must outlive this object.
  /// `onScreen`: the cache of screen space, without `initial` records.
  ViewRecords(const RayScene& rays, const Gatherer& gatherer,
    const RecordPlacementSettings& settings, float normalAngle, bool onScreen,
    const std::vector<Record>& initial);

  /// All records of the picture. False when `progress` stopped it.
  bool PlaceLevels(const ProgressCallback& progress);

  InterpolationResult LookUp(const ShadingPoint& place) const
  {
    return this->Screen ? this->Screen->LookUp(place) : this->Tree.LookUp(place);
  }

  /// The same in world space; makes a record where none serves [IC].
  InterpolationResult LookUpOrGather(const ShadingPoint& place);

  /// Without records, to about the error `tolerance`; adds its rays to `rays`.
  InterpolationResult Gather(const ShadingPoint& place, double tolerance, long long& rays) const;

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
    return this->Screen ? this->Screen->GetRays() : this->Places.GetRays() + this->LazyRays;
  }

private:
  float PixelAt(glm::vec3 position) const;

  const RayScene& Rays;
  const Gatherer& Source;
  RecordOctree Tree;
  RecordPlacement Places;
  std::unique_ptr<ScreenSpaceRecords> Screen; ///< null: world space
  std::mutex Lock;                            ///< of Tree and LazyRays in LookUpOrGather()
  long long LazyRays = 0;
};

}
#endif
