// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays from the visible surface into the hemisphere above it: the mean of a few a pixel.
#ifndef penumbra_TracedOcclusion_h
#define penumbra_TracedOcclusion_h

#include "Frame/Stage.h"
#include "SurfaceFromDepth.h"

#include <vector>

namespace penumbra
{

struct TracedSamples
{
  int First = 0;             ///< samples that every pixel has had
  int Count = 1;             ///< more of them
  float Reach = 1.f;         ///< of the rays, in scene coordinates
  InterleavedPixels Lattice; ///< that the points are of
};

/// Fills `means` within `parts` of a picture of this width, 0 open, 1 blocked. Returns the number of
/// rays.
long long TraceOcclusion(const std::vector<SurfacePoint>& points, int width, const RayScene& rays,
  const TracedSamples& samples, const std::vector<Rectangle>& parts, std::vector<float>& means);

}
#endif
