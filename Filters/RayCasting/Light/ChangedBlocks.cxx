// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ChangedBlocks.h"

#include <algorithm>
#include <cstddef>

namespace penumbra
{
namespace
{

constexpr int BiasSide = 1 << BiasLevel;
constexpr int BlocksOfTile = LightTileSide / BiasSide;
constexpr unsigned int AllLevels = (1u << LightLevels) - 1u;

static_assert(LightTileSide == 1 << LightLevels && 2 * BiasSide == LightTileSide,
  "FindLevels() knows the blocks next to half a tile");

/// Returns flags of the cells within `distance` of cells with a flag, on each axis.
std::vector<char> Extend(std::vector<char> flags, glm::ivec2 size, int distance)
{
  for (int axis = 0; axis < 2; ++axis)
  {
    const std::vector<char> before = flags;
    const int stride = axis == 0 ? 1 : size.x;
    for (int i = 0; i < size.x * size.y; ++i)
    {
      const int at = axis == 0 ? i % size.x : i / size.x;
      if (before[i] != 0)
      {
        const int last = std::min(at + distance, size[axis] - 1);
        for (int k = std::max(at - distance, 0); k <= last; ++k)
        {
          flags[i + (k - at) * stride] = 1;
        }
      }
    }
  }
  return flags;
}

}

ChangedBlocks::ChangedBlocks(glm::ivec2 tiles, const std::vector<int>& changed)
  : Size(tiles),
    Changed(static_cast<std::size_t>(tiles.x) * tiles.y, 0)
{
  for (const int tile : changed)
  {
    this->Changed[tile] = 1;
  }
  this->FindModels(Extend(this->Changed, tiles, 1));
  this->FindEstimates(Extend(this->Changed, tiles, 2));
  this->FindBias();
}

bool ChangedBlocks::HasChanges(glm::ivec2 low, glm::ivec2 high) const
{
  const glm::ivec2 first = glm::max(low, glm::ivec2(0)) / LightTileSide;
  const glm::ivec2 last = glm::min((high - 1) / LightTileSide, this->Size - 1);
  for (int y = first.y; y <= last.y; ++y)
  {
    for (int x = first.x; x <= last.x; ++x)
    {
      if (this->Changed[static_cast<std::size_t>(y) * this->Size.x + x] != 0)
      {
        return true;
      }
    }
  }
  return false;
}

// A window reaches to the next block.
void ChangedBlocks::FindModels(const Flags& near)
{
  for (int l = 0; l < LightLevels; ++l)
  {
    const int side = 2 << l;
    const int ratio = LightTileSide / side;
    for (std::size_t tile = 0; tile < near.size(); ++tile)
    {
      const glm::ivec2 first = ratio *
        glm::ivec2(static_cast<int>(tile) % this->Size.x, static_cast<int>(tile) / this->Size.x);
      for (int i = 0; near[tile] != 0 && i < ratio * ratio; ++i)
      {
        const glm::ivec2 at = first + glm::ivec2(i % ratio, i / ratio);
        if (this->HasChanges((at - 1) * side, (at + 2) * side))
        {
          this->Models[l].push_back(at.y * this->Size.x * ratio + at.x);
        }
      }
    }
  }
}

// Models are blended with those of the next blocks; those of whole tiles with that on the nearer side.
unsigned int ChangedBlocks::FindLevels(glm::ivec2 block) const
{
  unsigned int levels = 0;
  for (int l = 0; l + 1 < LightLevels; ++l)
  {
    const int margin = 2 * (2 << l);
    levels |=
      this->HasChanges(block * BiasSide - margin, (block + 1) * BiasSide + margin) ? 1u << l : 0u;
  }
  const glm::ivec2 upper =
    block % BlocksOfTile; // 1: the next tile is the nearer one, 0: the one before
  const glm::ivec2 first = block / BlocksOfTile - 2 + upper;
  levels |= this->HasChanges(first * LightTileSide, (first + 4) * LightTileSide)
    ? 1u << (LightLevels - 1)
    : 0u;
  return levels;
}

void ChangedBlocks::FindEstimates(const Flags& near)
{
  for (std::size_t tile = 0; tile < near.size(); ++tile)
  {
    const glm::ivec2 first = BlocksOfTile *
      glm::ivec2(static_cast<int>(tile) % this->Size.x, static_cast<int>(tile) / this->Size.x);
    for (int i = 0; near[tile] != 0 && i < BlocksOfTile * BlocksOfTile; ++i)
    {
      const glm::ivec2 at = first + glm::ivec2(i % BlocksOfTile, i / BlocksOfTile);
      const unsigned int levels = this->Changed[tile] != 0 ? AllLevels : this->FindLevels(at);
      if (levels != 0)
      {
        this->Evaluated.push_back({ at.y * this->Size.x * BlocksOfTile + at.x, levels });
      }
    }
  }
}

void ChangedBlocks::FindBias()
{
  const glm::ivec2 size = this->Size * BlocksOfTile;
  Flags flags(static_cast<std::size_t>(size.x) * size.y, 0);
  for (const Estimates& estimates : this->Evaluated)
  {
    flags[estimates.Block] = 1;
  }
  flags = Extend(std::move(flags), size, BiasRegion);
  this->Biased = List(flags, this->Size, BlocksOfTile);
  flags = Extend(std::move(flags), size, 1);
  this->Combined = List(flags, this->Size, BlocksOfTile);
  for (const int block : this->Combined)
  {
    const int tile = block / size.x / BlocksOfTile * this->Size.x + block % size.x / BlocksOfTile;
    if (this->Tiles.empty() || this->Tiles.back() != tile)
    {
      this->Tiles.push_back(tile);
    }
  }
}

std::vector<int> ChangedBlocks::List(const Flags& flags, glm::ivec2 size, int ratio)
{
  std::vector<int> blocks;
  for (int tile = 0; tile < size.x * size.y; ++tile)
  {
    const glm::ivec2 first = ratio * glm::ivec2(tile % size.x, tile / size.x);
    for (int i = 0; i < ratio * ratio; ++i)
    {
      const int block = (first.y + i / ratio) * size.x * ratio + first.x + i % ratio;
      if (flags[block] != 0)
      {
        blocks.push_back(block);
      }
    }
  }
  return blocks;
}

}
