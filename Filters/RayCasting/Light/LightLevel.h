// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The patches of blocks of one size, and how the models of neighboring blocks are blended.
#ifndef penumbra_LightLevel_h
#define penumbra_LightLevel_h

#include "LightPatch.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace penumbra
{

/// Index of no patch.
constexpr std::uint32_t NoPatch = 0xffffffffu;
constexpr int WindowBlocks = 9; ///< blocks of a window, row by row; the central one is the fifth

/// The patches of one level, with their windows and models.
template <int N>
struct LightLevel
{
  int Side = 1; ///< of a block, in cells
  glm::ivec2 Blocks{ 0 };
  std::vector<std::uint32_t> Begin; ///< first patch of each block, and their number
  std::vector<LightPatch<N>> Patches;
  std::vector<std::uint32_t> Parents; ///< patch of the next level
  struct Window
  {
    std::uint32_t Patches[WindowBlocks]; ///< that match the central one, or NoPatch
  };
  std::vector<Window> Windows;
  std::vector<LightModel<N>> Models;

  int GetNumberOfBlocks() const { return this->Blocks.x * this->Blocks.y; }
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
