// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Shapes whose edges are projected tile by tile, because all of them together would need much memory.
#ifndef penumbra_EdgeSource_h
#define penumbra_EdgeSource_h

#include "Silhouettes.h"
#include "Tiles/TileGrid.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace penumbra
{

/// Bounds of a shape in the image.
struct ShapeBounds
{
  bool IsVisible = true;
  bool IsKnown = false; ///< false if the shape reaches the camera plane
  double Depth = 0.0;   ///< of the nearest point, or less
  glm::dvec2 Low{ 0.0 };
  glm::dvec2 High{ 0.0 };
};

class EdgeSource
{
public:
  virtual ~EdgeSource() = default;

  /// Returns the number of shapes whose bounds overlap a tile, without the large ones.
  std::size_t GetCount(int tile) const
  {
    return this->ByTile.GetNumberOfBins() == 0 ? 0 : this->ByTile.GetCount(tile);
  }

  using BoundsTest = std::function<bool(const ShapeBounds&)>;

  /// Returns the shapes in a tile, without the large ones and those for which `isHidden` is true, if it is set.
  std::vector<std::uint32_t> Select(int tile, const BoundsTest& isHidden = {}) const;

  /// Appends the edges of shapes, clipped to the rectangle [low, high] enlarged by twice EdgeMargin.
  void Project(const std::vector<std::uint32_t>& shapes, glm::dvec2 low, glm::dvec2 high,
    std::vector<ProjectedEdge>& edges) const;

  /// Appends the edges of large shapes, which are not in the tiles, as ProjectEdges().
  long long ProjectLarge(const ImagePart& part, std::vector<ProjectedEdge>& edges) const;

protected:
  /// Sorts the shapes [0, count) by tiles. Those that overlap at least `minimumLarge` tiles of the whole
  /// image of `camera` are large.
  void SortByTiles(
    std::size_t count, const TileGrid& tiles, int minimumLarge, const Camera& camera);

  virtual ShapeBounds FindBounds(std::uint32_t shape) const = 0;
  /// Appends the edges of a shape, clipped to the rectangle [low, high].
  virtual void ProjectShape(std::uint32_t shape, glm::dvec2 low, glm::dvec2 high,
    std::vector<ProjectedEdge>& edges) const = 0;

private:
  Bins<std::uint32_t> ByTile;
  std::vector<std::uint32_t> Large;
};

}
#endif
