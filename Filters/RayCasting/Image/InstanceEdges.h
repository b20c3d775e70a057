// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Edges of surfaces with Instances. Silhouettes are found in the coordinates of the shape, and only
// they are transformed and projected, tile by tile.
#ifndef penumbra_InstanceEdges_h
#define penumbra_InstanceEdges_h

#include "Edges/Silhouettes.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace penumbra
{

struct Scene;

class InstanceEdges
{
public:
  /// Finds the instances whose bounds in the image overlap the tiles: `cells.x` by `cells.y`
  /// squares of side `size` with the lower left corner `origin`. `mesh` holds the edges of each
  /// surface; if empty, no edges are found. Both arguments must outlive this object.
  InstanceEdges(const Scene& scene, const std::vector<std::vector<MeshEdge>>& mesh,
    glm::dvec2 origin, double size, glm::ivec2 cells);

  /// Returns the number of instances in a tile, without the large ones.
  std::size_t GetCount(int tile) const
  {
    return this->Begin.empty() ? 0 : this->Begin[tile + 1] - this->Begin[tile];
  }

  /// Appends the edges of the instances in a tile, clipped to the rectangle [low, high] enlarged by
  /// twice EdgeMargin.
  void Project(int tile, glm::dvec2 low, glm::dvec2 high, std::vector<ProjectedEdge>& edges) const;

  /// Appends the edges of large instances, which overlap many tiles.
  void ProjectLarge(glm::dvec2 low, glm::dvec2 high, std::vector<ProjectedEdge>& edges) const;

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

  template <typename Visit>
  void VisitTiles(glm::dvec2 origin, double size, glm::ivec2 cells, Id id, Visit visit) const;
  void ProjectInstance(
    Id id, glm::dvec2 low, glm::dvec2 high, std::vector<ProjectedEdge>& edges) const;

  const Scene& TracedScene;
  std::vector<Shape> Shapes;
  std::vector<std::uint32_t> Begin; ///< first entry of each tile in Instances, and the end
  std::vector<Id> Instances;
  std::vector<Id> Large;
};

}
#endif
