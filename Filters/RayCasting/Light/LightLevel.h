// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The patches of blocks of one size, and how the models of neighboring blocks are blended.
#ifndef penumbra_LightLevel_h
#define penumbra_LightLevel_h

#include "LightPatch.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace penumbra
{

/// Index of no patch.
constexpr std::uint32_t NoPatch = 0xffffffffu;
constexpr int WindowBlocks = 9; ///< blocks of a window, row by row; the central one is the fifth

/// Resizes a vector that seldom grows, and then by few elements.
template <typename Element>
void GrowTo(std::vector<Element>& elements, std::size_t size)
{
  if (size > elements.capacity())
  {
    elements.reserve(size + size / 16);
  }
  elements.resize(size);
}

/// The patches of one level, with their windows and models. Those of a tile are consecutive. Between them there may be
/// unused ones, where tiles had more patches.
template <int N>
struct LightLevel
{
  int Side = 1; ///< of a block, in cells
  glm::ivec2 Blocks{ 0 };
  struct Range
  {
    std::uint32_t Begin = 0;
    std::uint32_t End = 0;
  };
  std::vector<Range> Ranges; ///< patches of each block
  std::vector<Range> Tiles;  ///< where each tile has room for patches
  std::vector<LightPatch<N>> Patches;
  std::vector<std::uint32_t> Parents; ///< patch of the next level
  struct Window
  {
    std::uint32_t Patches[WindowBlocks]; ///< that match the central one, or NoPatch
  };
  std::vector<Window> Windows;
  std::vector<LightModel<N>> Models;

  int GetNumberOfBlocks() const { return this->Blocks.x * this->Blocks.y; }

  /// Makes room for count(i) patches of each of `tiles`, at the end if there are too many for the present one.
  template <typename GetCount>
  void MakeRoom(const std::vector<int>& tiles, const GetCount& count)
  {
    auto size = static_cast<std::uint32_t>(this->Patches.size());
    for (std::size_t i = 0; i < tiles.size(); ++i)
    {
      Range& room = this->Tiles[tiles[i]];
      const auto patches = static_cast<std::uint32_t>(count(i));
      if (patches > room.End - room.Begin)
      {
        room = { size, size + patches };
        size += patches;
      }
    }
    GrowTo(this->Patches, size);
    GrowTo(this->Parents, size);
    GrowTo(this->Windows, size);
    GrowTo(this->Models, size);
  }

  /// Calls visit(patch) for the patches of a block.
  template <typename Visit>
  void VisitPatches(int block, const Visit& visit) const
  {
    for (std::uint32_t p = this->Ranges[block].Begin; p < this->Ranges[block].End; ++p)
    {
      visit(p);
    }
  }
};

/// Weights of the patches of a window for a patch of the first level in its
/// central block, whose first cell is `cell`.
struct ModelBlend
{
  std::uint32_t Patches[4];
  float Weights[4];
  int Count = 0;

  template <int N>
  ModelBlend(const LightLevel<N>& level, std::uint32_t patch, glm::ivec2 cell)
  {
    const typename LightLevel<N>::Window& window = level.Windows[patch];
    int step[2];
    float beside[2];
    for (int axis = 0; axis < 2; ++axis)
    {
      const float at =
        (static_cast<float>(cell[axis] % level.Side) + 1.f) / static_cast<float>(level.Side) - 0.5f;
      step[axis] = at < 0.f ? -1 : 1;
      beside[axis] = std::abs(at);
    }
    float sum = 0.f;
    for (int i = 0; i < 4; ++i)
    {
      const int x = i & 1 ? step[0] : 0;
      const int y = i >> 1 ? step[1] : 0;
      const std::uint32_t other = window.Patches[4 + 3 * y + x];
      if (other != NoPatch)
      {
        this->Patches[this->Count] = other;
        this->Weights[this->Count] =
          (i & 1 ? beside[0] : 1.f - beside[0]) * (i >> 1 ? beside[1] : 1.f - beside[1]);
        sum += this->Weights[this->Count++];
      }
    }
    for (int i = 0; i < this->Count; ++i)
    {
      this->Weights[i] /= sum;
    }
  }
};

}
#endif
