// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Traces a few cosine-distributed rays per pixel from the visible surface and averages their
// occlusion.
#ifndef penumbra_TracedOcclusion_h
#define penumbra_TracedOcclusion_h

#include "Frame/Stage.h"
#include "SurfaceFromDepth.h"

#include <vector>

namespace penumbra
{

struct TracedSamples
{
  int First = 0;             ///< index of the first sample
  int Count = 1;             ///< number of samples per pixel
  float Radius = 1.f;        ///< length of the rays, in scene units
  InterleavedPixels Lattice; ///< lattice of the points
};

/// Fills `means` (0 open, 1 blocked) within the rectangles `parts` of an image with `width`
/// columns. Returns the number of rays.
long long TraceOcclusion(const std::vector<SurfacePoint>& points, int width, const RayScene& rays,
  const TracedSamples& samples, const std::vector<Rectangle>& parts, std::vector<float>& means);

}
#endif
