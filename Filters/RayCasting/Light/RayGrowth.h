// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Decides how many rays the pixels of a tile get in the next round.
#ifndef penumbra_RayGrowth_h
#define penumbra_RayGrowth_h

#include "LightConstants.h"
#include "SiteGrid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace penumbra
{

/// Sum over pixels.
struct ErrorSum
{
  float Squares = 0.f;
  int Count = 0;
};

/// Adds the squared errors of the pixels [low, high), except negative ones.
template <typename SquaredError>
ErrorSum SumErrors(glm::ivec2 low, glm::ivec2 high, const SquaredError& squaredErrorAt)
{
  ErrorSum sum;
  for (int y = low.y; y < high.y; ++y)
  {
    for (int x = low.x; x < high.x; ++x)
    {
      const float square = squaredErrorAt(x, y);
      sum.Squares += square < 0.f ? 0.f : square;
      sum.Count += square < 0.f ? 0 : 1;
    }
  }
  return sum;
}

/// Multiplies a number of rays, 2^k or 1.5 x 2^k, by `factor` or a little more, but at most by
/// LargestRayGrowth.
inline int GrowRays(int rays, float factor)
{
  const float wanted = static_cast<float>(rays) * std::min(factor, LargestRayGrowth);
  while (static_cast<float>(rays) < wanted && rays < MaximumSiteRays / Halves)
  {
    rays += (rays & (rays - 1)) == 0 ? rays / 2 : rays / 3;
  }
  return rays;
}

template <int N>
bool IncreaseBlock(SiteGrid<N>& grid, glm::ivec2 low, glm::ivec2 high, float factor)
{
  if (!(factor > 1.f))
  {
    return false;
  }
  bool isIncreased = false;
  for (int y = low.y; y < high.y; ++y)
  {
    for (int x = low.x; x < high.x; ++x)
    {
      LightPixel& pixel = grid.GetPixel(x, y);
      if (pixel.Sites > 0 && pixel.Target < MaximumSiteRays / Halves)
      {
        pixel.Target = static_cast<std::uint16_t>(GrowRays(pixel.Target, factor));
        isIncreased = true;
      }
    }
  }
  return isIncreased;
}

/// Increases the targets of pixels in the tile [first, end) if the mean of its squared errors exceeds
/// `limit`. Returns true if it has increased any. squaredErrorAt(x, y) is negative at pixels that do not
/// count.
// Numbers of rays in proportion to the errors of blocks of pixels would lead to the smallest error of the
// tile (Neyman allocation) if neighbors did not share their rays. They grow by the mean of this and of
// the same factor in the whole tile.
template <int N, typename SquaredError>
bool IncreaseTile(SiteGrid<N>& grid, glm::ivec2 first, glm::ivec2 end, float limit,
  const SquaredError& squaredErrorAt)
{
  const ErrorSum tile = SumErrors(first, end, squaredErrorAt);
  const float accepted = static_cast<float>(tile.Count) * limit;
  if (tile.Squares <= accepted)
  {
    return false;
  }
  bool isIncreased = false;
  for (int i = 0; i < RayBlocks * RayBlocks; ++i)
  {
    const glm::ivec2 low = first + RayBlockSide * glm::ivec2(i % RayBlocks, i / RayBlocks);
    const glm::ivec2 high = glm::min(low + RayBlockSide, end);
    const ErrorSum block = SumErrors(low, high, squaredErrorAt);
    const float share = block.Squares * static_cast<float>(tile.Count) /
      (tile.Squares * static_cast<float>(block.Count));
    isIncreased |= block.Count > 0 &&
      IncreaseBlock(grid, low, high, 0.5f * (1.f + std::sqrt(share)) * tile.Squares / accepted);
  }
  return isIncreased;
}

}
#endif
