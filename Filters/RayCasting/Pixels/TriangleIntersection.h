// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Intersections of triangles and spheres: image edges that do not correspond to a mesh edge.
#ifndef penumbra_TriangleIntersection_h
#define penumbra_TriangleIntersection_h

#include "PixelArrangement.h"
#include "Sampling/PrimitiveId.h"

#include <glm/glm.hpp>

#include <vector>

namespace penumbra
{

struct Scene;
struct Surface;

/**
 * Returns the largest depth in the pixel with the lower left corner `origin` of the plane of a
 * triangle, infinity if the plane is unbounded there, or of a visible sphere or tube.
 */
double MaximumDepthInPixel(const Scene& scene, PrimitiveId id, glm::dvec2 origin);

/// Returns true if two triangles have two equal positions.
bool HaveCommonEdge(const std::vector<Surface>& surfaces, PrimitiveId a, PrimitiveId b);

/**
 * Computes the projected intersection of `a` and `b` in the pixel with the lower left corner
 * `origin`. Returns false if they do not intersect there, or if they have a common edge, which is
 * then the edge between them.
 */
bool IntersectTriangles(
  const Scene& scene, PrimitiveId a, PrimitiveId b, glm::dvec2 origin, PixelSegment& segment);

/// Appends the projected intersection of a sphere with a sphere or triangle in the pixel with the
/// lower left corner `origin`. The intersections of tubes are not computed.
void IntersectSphere(const Scene& scene, PrimitiveId a, PrimitiveId b, glm::dvec2 origin,
  std::vector<PixelSegment>& segments);

/// Returns true if a tube may be visible in the pixel with the lower left corner `origin`.
bool IsTubeInPixel(const Scene& scene, PrimitiveId id, glm::dvec2 origin);

/// Returns true if one of `a` and `b` is a tube whose surface may intersect the other in the pixel with
/// the lower left corner `origin`. False for tubes with a common end and for those of a joint.
bool MayIntersectTube(const Scene& scene, PrimitiveId a, PrimitiveId b, glm::dvec2 origin);

}
#endif
