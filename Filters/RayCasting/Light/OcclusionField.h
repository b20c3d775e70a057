// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Ambient occlusion of the pixels of an image, estimated for all of them together.
#ifndef penumbra_OcclusionField_h
#define penumbra_OcclusionField_h

#include "Execution/ParallelFor.h"
#include "LightSite.h"
#include "OcclusionRays.h"
#include "Sampling/RayCounts.h"

namespace penumbra
{

class CameraRayTracer;

class OcclusionField
{
public:
  /// Estimates the occlusion in the pixels [low, high) of the image to `tolerance`, the RMSE of a tile,
  /// where a white surface has the color 1. The estimates depend neither on `low` and `high` nor on
  /// the number of threads. Adds the rays to `counts`. Throws Stopped if `progress` requests a stop.
  OcclusionField(const CameraRayTracer& tracer, const OcclusionRays& rays, double tolerance,
    glm::ivec2 low, glm::ivec2 high, const ProgressCallback& progress, RayCounts& counts);

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

  friend class TileSamples;
};

}
#endif
