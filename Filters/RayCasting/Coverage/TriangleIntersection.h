// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Where two triangles pass through each other the picture has a border that no edge of a mesh gives.
#ifndef penumbra_TriangleIntersection_h
#define penumbra_TriangleIntersection_h

#include "PixelArrangement.h"
#include "Scene.h"

#include <cstdint>

namespace penumbra
{

/// A triangle of a scene.
struct TriangleId
{
  std::uint32_t Surface;
  std::uint32_t Triangle;

  bool operator==(const TriangleId& other) const
  {
    return this->Surface == other.Surface && this->Triangle == other.Triangle;
  }
};

/**
 * The largest depth that the plane of a triangle reaches in the pixel whose lower left corner is
 * `origin`; infinity where it runs away.
 */
double MaximumDepthInPixel(const Scene& scene, TriangleId id, glm::dvec2 origin);

/// Do two triangles have two places in common?
bool ShareAnEdge(const Scene& scene, TriangleId a, TriangleId b);

/**
 * The line along which `a` and `b` pass through each other, as seen in the pixel whose lower left
 * corner is `origin`. False when they do not meet there, or share an edge (then that is the border
 * between them).
 */
bool IntersectTriangles(
  const Scene& scene, TriangleId a, TriangleId b, glm::dvec2 origin, PixelSegment& segment);

}
#endif
