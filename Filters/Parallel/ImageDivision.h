// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Divides an image among ranks: into rectangles of about equal work, each of which is rendered by the
// rank that has most of what it shows.
#ifndef penumbra_ImageDivision_h
#define penumbra_ImageDivision_h

#include "Image/ImageRenderer.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace penumbra
{

class ImageDivision
{
public:
  /// Side of a tile in pixels, that of the tiles of the ray caster.
  static constexpr int TileSide = 32;

  /// Divides an image of `size` pixels into about `partsPerRank` rectangles for each rank.
  /// `counts` has the number of primitives of each rank in each tile, row by row from the bottom.
  /// The division depends on nothing else.
  ImageDivision(
    glm::ivec2 size, const std::vector<std::vector<std::uint32_t>>& counts, int partsPerRank);

  static glm::ivec2 CountTiles(glm::ivec2 size) { return (size + TileSide - 1) / TileSide; }

  /// Returns the rank that renders a tile.
  int GetOwner(int tile) const { return this->Owners[static_cast<std::size_t>(tile)]; }

  /// Returns the pixels that a rank renders, as rectangles of whole tiles.
  std::vector<RegionBounds> GetRegions(int rank) const;

private:
  /// The tiles [Low, High).
  struct Part
  {
    glm::ivec2 Low, High;
    int Owner = 0;
  };

  void Split(glm::ivec2 low, glm::ivec2 high, int parts, const std::vector<double>& work);
  void Assign(
    const std::vector<std::vector<std::uint32_t>>& counts, const std::vector<double>& work);
  template <typename Value>
  double Sum(const Part& part, const std::vector<Value>& values) const;

  glm::ivec2 Size, Tiles;
  std::vector<Part> Parts;
  std::vector<int> Owners;
};

}
#endif
