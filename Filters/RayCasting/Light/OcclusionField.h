// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Ambient occlusion of the pixels of an image, estimated for all of them together.
#ifndef penumbra_OcclusionField_h
#define penumbra_OcclusionField_h

#include "Execution/ParallelFor.h"
#include "Execution/WorkLimit.h"
#include "LightSite.h"
#include "OcclusionRays.h"
#include "Sampling/RayCounts.h"

#include <memory>

namespace penumbra
{

class CameraRayTracer;

class TileSamples;

class OcclusionField
{
public:
  /// Prepares the estimate of the occlusion in the pixels [low, high) of the image to `tolerance`, the
  /// RMSE of a tile, where a white surface has the color 1. The estimates depend neither on `low` and
  /// `high` nor on the number of threads.
  OcclusionField(const CameraRayTracer& tracer, const OcclusionRays& rays, double tolerance,
    glm::ivec2 low, glm::ivec2 high);
  ~OcclusionField();

  /// Finds the visible surfaces with few rays each, the first round. Returns false if `limit` (null:
  /// none) ended it; the next call continues. `progress` receives fractions in [from, to]. Adds the rays
  /// to `counts`. Throws Stopped if `progress` requests a stop.
  bool FindSites(
    WorkLimit* limit, double from, double to, const ProgressCallback& progress, RayCounts& counts);

  /// Adds rays in further rounds until the tolerance is met; as FindSites(), which must have finished.
  bool AddRounds(
    WorkLimit* limit, double from, double to, const ProgressCallback& progress, RayCounts& counts);

  /// Returns true if FindSites() has finished. The results are available from then on.
  bool HasSites() const { return this->Round > 0; }

  /// Factor of the unoccluded color of a pixel.
  struct Factor
  {
    glm::vec3 Value{ 1.f };
    float Error = 0.f; ///< estimated standard error of the color
  };
  Factor At(int x, int y) const;

  /// Returns the mean occlusion of the surfaces in a pixel, in [0, 1].
  float GetMean(int x, int y) const;

private:
  /// Occlusion of a site.
  float Evaluate(const LightSite& site) const;

  SiteGrid Grid;
  std::unique_ptr<TileSamples> Tiles;
  double Tolerance;
  int Round = 0; ///< next one; 0: the sites are not known

  friend class TileSamples;
};

}
#endif
