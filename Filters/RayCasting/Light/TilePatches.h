// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The patches of the sites of one tile, at all levels.
#ifndef penumbra_TilePatches_h
#define penumbra_TilePatches_h

#include "LightPatch.h"
#include "SiteGrid.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace penumbra
{

/// All indices are relative to the tile. The blocks of the last level are whole tiles.
template <int N>
class TilePatches
{
public:
  using Patch = LightPatch<N>;

  struct Level
  {
    std::vector<Patch> Patches;
    std::vector<std::uint32_t> Parents; ///< patch of the next level
    std::vector<std::uint32_t> Begin;   ///< first patch of each block, row by row, and their number
  };
  Level Levels[LightLevels];

  /// Makes the patches of a tile, and sets those of its sites.
  void Make(SiteGrid<N>& grid, std::size_t tile)
  {
    if (grid.Tiles[tile].empty())
    {
      return;
    }
    this->MakeFirstLevel(grid, grid.Tiles[tile]);
    for (int l = 1; l < LightLevels; ++l)
    {
      this->MakeLevel(this->Levels[l - 1], this->Levels[l], LightTileSide >> (l + 1));
    }
  }

private:
  void MakeFirstLevel(SiteGrid<N>& grid, const std::vector<LightPixel>& pixels)
  {
    constexpr int Blocks = LightTileSide / 2;
    Level& level = this->Levels[0];
    for (int block = 0; block < Blocks * Blocks; ++block)
    {
      level.Begin.push_back(static_cast<std::uint32_t>(level.Patches.size()));
      const int first = block / Blocks * 2 * LightTileSide + block % Blocks * 2;
      for (int i = 0; i < 4; ++i)
      {
        const LightPixel& pixel = pixels[first + (i >> 1) * LightTileSide + (i & 1)];
        for (std::uint32_t k = pixel.Begin; k < pixel.Begin + pixel.Sites; ++k)
        {
          LightSite<N>& site = grid.Sites[k];
          Patch part;
          part.Add(site, pixel.GetPart(site));
          site.Patch = AddPart(level, part);
        }
      }
    }
    level.Begin.push_back(static_cast<std::uint32_t>(level.Patches.size()));
  }

  /// `blocks`: number of blocks of `level` on each side of the tile.
  static void MakeLevel(Level& finer, Level& level, int blocks)
  {
    finer.Parents.resize(finer.Patches.size());
    for (int block = 0; block < blocks * blocks; ++block)
    {
      level.Begin.push_back(static_cast<std::uint32_t>(level.Patches.size()));
      for (int i = 0; i < 4; ++i)
      {
        const int child =
          (2 * (block / blocks) + (i >> 1)) * 2 * blocks + 2 * (block % blocks) + (i & 1);
        for (std::uint32_t k = finer.Begin[child]; k < finer.Begin[child + 1]; ++k)
        {
          finer.Parents[k] = AddPart(level, finer.Patches[k]);
        }
      }
    }
    level.Begin.push_back(static_cast<std::uint32_t>(level.Patches.size()));
  }

  /// Adds `part` to the patch of the last block that it matches, or as a new one. Returns its index.
  static std::uint32_t AddPart(Level& level, const Patch& part)
  {
    for (std::size_t i = level.Begin.back(); i < level.Patches.size(); ++i)
    {
      if (level.Patches[i].Matches(part))
      {
        level.Patches[i].Add(part, 1.f);
        return static_cast<std::uint32_t>(i);
      }
    }
    level.Patches.push_back(part);
    return static_cast<std::uint32_t>(level.Patches.size() - 1);
  }
};

}
#endif
