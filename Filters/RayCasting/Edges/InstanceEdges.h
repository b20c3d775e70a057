// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Edges of surfaces with Instances. Silhouettes are found in the coordinates of the shape, and only
// they are transformed and projected, tile by tile.
#ifndef penumbra_InstanceEdges_h
#define penumbra_InstanceEdges_h

#include "EdgeSource.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

struct Scene;

/// The instances of a scene, numbered through all surfaces. Those that overlap many tiles are large.
class InstanceEdges final : public EdgeSource
{
public:
  /// `mesh` holds the edges of each surface; if empty, no edges are found. Both arguments must outlive
  /// this object.
  InstanceEdges(
    const Scene& scene, const std::vector<std::vector<MeshEdge>>& mesh, const TileGrid& tiles);

private:
  /// Edges of the shape of one surface. The arrays of planes have one entry per edge between two
  /// triangles that is not a feature edge.
  struct Shape
  {
    const Surface* Data;
    std::vector<std::uint32_t> Features; ///< (A, B) of each feature edge
    std::vector<std::uint32_t> Smooth;   ///< (A, B) of each other edge
    /// Unit normals and offsets of the planes of both triangles. The edge is a silhouette if the
    /// camera is on the same side of both.
    std::vector<float> Planes[8];

    Shape(const Surface& surface, const std::vector<MeshEdge>& mesh);
  };
  struct Id
  {
    std::uint32_t Shape;
    std::uint32_t Instance;
  };

  ShapeBounds FindBounds(std::uint32_t instance) const override;
  void ProjectShape(std::uint32_t instance, glm::dvec2 low, glm::dvec2 high,
    std::vector<ProjectedEdge>& edges) const override;

  const Scene& TracedScene;
  std::vector<Shape> Shapes;
  std::vector<Id> Instances;
};

}
#endif
