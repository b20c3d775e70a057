// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Outlines of spheres and tubes in the image, and circles in space, as chords. Each chord cuts off
// as much area as it adds, so that the area of a pixel on either side is exact to about 5e-5.
#ifndef penumbra_RoundOutlines_h
#define penumbra_RoundOutlines_h

#include "Silhouettes.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

struct Scene;

/// The spheres and tubes of a scene, numbered through all surfaces, and those in each tile.
class RoundOutlines
{
public:
  /// Finds the shapes whose bounds in the image overlap the tiles: `cells.x` by `cells.y` squares
  /// of side `size` with the lower left corner `origin`.
  RoundOutlines(const Scene& scene, glm::dvec2 origin, double size, glm::ivec2 cells);

  std::size_t GetCount(int tile) const
  {
    return this->Begin.empty() ? 0 : this->Begin[tile + 1] - this->Begin[tile];
  }
  std::size_t GetTotal() const { return this->Shapes.size(); }

  /// Appends the outlines of the shapes in a tile, clipped to the rectangle [low, high] enlarged by
  /// twice EdgeMargin.
  void Project(int tile, glm::dvec2 low, glm::dvec2 high, std::vector<ProjectedEdge>& edges) const;

private:
  const Scene& OutlinedScene;
  std::vector<std::uint32_t> Surfaces;   ///< indices of the surfaces of spheres and tubes
  std::vector<std::uint32_t> FirstShape; ///< number of the first shape of each, and the end
  std::vector<std::uint32_t> Begin;      ///< first entry of each tile in Shapes, and the end
  std::vector<std::uint32_t> Shapes;
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
