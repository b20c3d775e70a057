// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The sites of the pixels of an image, and their joined estimates.
#ifndef penumbra_SiteGrid_h
#define penumbra_SiteGrid_h

#include "DirectionGuide.h"
#include "LightSite.h"

#include <cstddef>
#include <vector>

namespace penumbra
{

/// Joined estimate of neighboring sites of one surface: a linear function of the features.
template <int N>
struct SitePatch
{
  LightFeatures Mean{};
  using Values = typename LightTerms<N>::Value;
  Values Value{ 0.f }; ///< at the mean, times 1 - AloneWeight
  Values Slopes[LightFeatures::Count] = {};
  float AloneWeight = 0.f;    ///< weight of the rays of the site alone
  Values SquaredError{ 0.f }; ///< of a site
  /// Number of pixels that have the same error, as their estimates share rays.
  float SharedPixels = 1.f;
};

/// The sites of the pixels [Low, High), which are multiples of LightTileSide; pixels outside of the
/// image are empty. Tiles without sites take no memory for their pixels.
template <int N>
struct SiteGrid
{
  glm::ivec2 Low{ 0 };
  glm::ivec2 High{ 0 };
  std::vector<LightSite<N>> Sites;
  std::vector<std::vector<LightPixel>>
    Tiles; ///< pixels of each tile, row by row; empty: it has no sites
  std::vector<SitePatch<N>> Patches;
  std::vector<DirectionGuide> Guides; ///< of blocks, row by row
  /// Squared range of the value of a ray.
  typename LightTerms<N>::Value SquaredRange{ 1.f };

  /// Covers the pixels [low, high) of an image.
  void Cover(glm::ivec2 low, glm::ivec2 high, glm::ivec2 image)
  {
    const auto roundDown = [](glm::ivec2 p) {
      return glm::ivec2(glm::floor(glm::dvec2(p) / double(LightTileSide))) * LightTileSide;
    };
    this->Low = glm::max(roundDown(low), glm::ivec2(0));
    this->High = glm::min(roundDown(high), roundDown(image)) + LightTileSide;
  }

  glm::ivec2 GetSize() const { return this->High - this->Low; }
  /// Returns the index of the tile that contains a pixel.
  std::size_t GetTile(int x, int y) const
  {
    const glm::uvec2 at = glm::uvec2(x - this->Low.x, y - this->Low.y) / TileSide;
    return static_cast<std::size_t>(at.y) * (this->GetSize().x / LightTileSide) + at.x;
  }

  /// Returns the index of the block whose first pixel is `first`.
  std::size_t GetBlock(glm::ivec2 first) const
  {
    const glm::ivec2 at = (first - this->Low) / DirectionBlockSide;
    return static_cast<std::size_t>(at.y) * (this->GetSize().x / DirectionBlockSide) + at.x;
  }

  /// Returns a pixel; in a tile without sites, an empty one.
  const LightPixel& ReadPixel(int x, int y) const
  {
    static const LightPixel empty;
    const std::vector<LightPixel>& tile = this->Tiles[this->GetTile(x, y)];
    return tile.empty() ? empty : tile[this->GetCell(x, y)];
  }

  /// Returns a pixel of a tile with sites.
  LightPixel& GetPixel(int x, int y)
  {
    return this->Tiles[this->GetTile(x, y)][this->GetCell(x, y)];
  }

private:
  static constexpr unsigned int TileSide = LightTileSide;

  /// Returns the index of a pixel in its tile.
  std::size_t GetCell(int x, int y) const
  {
    const glm::uvec2 at = glm::uvec2(x - this->Low.x, y - this->Low.y) % TileSide;
    return static_cast<std::size_t>(at.y * TileSide + at.x);
  }
};

}
#endif
