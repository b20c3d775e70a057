// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The only place where it is decided how a pixel is integrated: the four cases of [AA], exact coverage,
// or samples.
#ifndef penumbra_PixelMethod_h
#define penumbra_PixelMethod_h

#include "Pixels/PixelEdges.h"

#include <optional>

namespace penumbra
{

/// Cases are those of [AA], see Documentation/methods/Antialiasing.md.
enum class PixelMethod
{
  Uniform,     ///< a regular grid of rays
  Subdivision, ///< [AA]: subdivided between objects
  Corners,     ///< cases 1 and 2: the mean of the corners, or the background
  Exact,       ///< cases 3 and 4: the areas of the faces between the edges
  ExactOnce,   ///< the same, which gives up if hidden edges or intersections divide the faces again
  Refinement,  ///< subdivided until the tolerance is met
  Texels,      ///< the areas of the texels of one triangle
  Faces,       ///< estimated from a ray per face, sampled only if the tile requires it
  SampledFaces, ///< the same, sampled at once
  Rays,         ///< traced samples
  LitRays,      ///< traced samples with light of their own
  Triangles,    ///< rasterized samples: the nearest triangle at each
  Layers        ///< rasterized samples: all triangles at each
};

/**
 * Chooses the method of the current pixel. Its only effects are that it loads the edges of the pixel, if
 * the choice depends on them, and selects the pixel in the rasterizer of the tile.
 * @param gaveUp The method that gave up in this pixel, which another one replaces.
 */
PixelMethod ChooseMethod(const PixelContext& pixel, PixelEdges& edges, const TileGeometry& tile,
  std::optional<PixelMethod> gaveUp = std::nullopt);

}
#endif
