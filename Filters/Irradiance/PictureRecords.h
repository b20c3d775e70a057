// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The records of one picture: made level by level over its pixels, or where a question finds none.
#ifndef penumbra_PictureRecords_h
#define penumbra_PictureRecords_h

#include "Placement.h"

#include <mutex>

namespace penumbra
{

class RayScene;

class PictureRecords
{
public:
  /// `rays` and `gatherer` must outlive this object.
  PictureRecords(const RayScene& rays, const Gatherer& gatherer, const PlacementSettings& settings,
    float normalAngle, const std::vector<Record>& initial);

  /// All records of the picture. False when `progress` stopped it.
  bool PlaceLevels(const ProgressCallback& progress);

  Interpolated LookUp(const Place& place) const { return this->Tree.LookUp(place); }

  /// The same; makes a record where none serves [IC].
  Interpolated LookUpOrGather(const Place& place);

  /// Without records, to about the error `tolerance`; adds its rays to `rays`.
  Interpolated Gather(const Place& place, double tolerance, long long& rays) const;

  const RecordTree& GetTree() const { return this->Tree; }
  long long GetRays() const { return this->Places.GetRays() + this->LazyRays; }

private:
  float PixelAt(glm::vec3 position) const;

  const RayScene& Rays;
  const Gatherer& Source;
  RecordTree Tree;
  Placement Places;
  std::mutex Lock; ///< of Tree and LazyRays in LookUpOrGather()
  long long LazyRays = 0;
};

}
#endif
