// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Traces a few cosine-distributed rays per pixel from the visible surface and sums up their occlusion.
#ifndef penumbra_TracedOcclusion_h
#define penumbra_TracedOcclusion_h

#include "SurfaceFromDepth.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

struct TracedSamples
{
  int First = 0;      ///< index of the first sample of all pixels
  float Radius = 1.f; ///< length of the rays, in scene units
};

/// Number of rays of each pixel of an image, row by row.
using PixelRays = std::vector<std::uint16_t>;

/// Adds the occlusion of each ray (0 open, 1 blocked) to the sum of its pixel, in an image with `width`
/// columns: `sums` has one value per pixel, or `stride` values of which the first is the sum. Returns the
/// number of rays, which is lower than that of `counts` in the background.
long long TraceOcclusion(const std::vector<SurfacePoint>& points, int width, const RayScene& rays,
  const TracedSamples& samples, const PixelRays& counts, std::vector<float>& sums, int stride = 1);

}
#endif
