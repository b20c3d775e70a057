// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Outlines of spheres and tubes in the image, and circles in space, as chords. Each chord cuts off
// as much area as it adds, so that the area of a pixel on either side is exact to about 5e-5.
#ifndef penumbra_RoundOutlines_h
#define penumbra_RoundOutlines_h

#include "EdgeSource.h"
#include "Sampling/PrimitiveId.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

struct Scene;

/// The spheres and tubes of a scene, numbered through all surfaces.
class RoundOutlines final : public EdgeSource
{
public:
  /// `scene` must outlive this object. None of the shapes are large.
  RoundOutlines(const Scene& scene, const TileGrid& tiles);

private:
  ShapeBounds FindBounds(std::uint32_t shape) const override;
  void ProjectShape(std::uint32_t shape, glm::dvec2 low, glm::dvec2 high,
    std::vector<ProjectedEdge>& edges) const override;
  /// Returns the surface of a shape and the index of the shape in the surface.
  PrimitiveId FindPrimitive(std::uint32_t shape) const;

  const Scene& OutlinedScene;
  std::vector<std::uint32_t> Surfaces;   ///< indices of the surfaces of spheres and tubes
  std::vector<std::uint32_t> FirstShape; ///< number of the first shape of each, and the end
};

/// Bounds of a sphere in the image. Returns false if they are unknown, because the sphere reaches
/// the camera plane.
bool BoundSphere(
  glm::dvec3 center, double radius, const Camera& camera, glm::dvec2& low, glm::dvec2& high);

/// Appends the outline of one sphere or tube, without the caps inside a joined tube, clipped to the
/// rectangle [low, high].
void ProjectOutline(const Surface& surface, std::uint32_t primitive, const Camera& camera,
  glm::dvec2 low, glm::dvec2 high, std::vector<ProjectedEdge>& edges);

/// Appends the projection of a circle with a unit `normal`, clipped to the rectangle [low, high].
/// Circles that reach the camera plane are skipped.
void ProjectCircle(glm::dvec3 center, double radius, glm::dvec3 normal, const Camera& camera,
  glm::dvec2 low, glm::dvec2 high, std::vector<ProjectedEdge>& edges);

}
#endif
