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

/// Estimated error of a pixel.
struct PixelError
{
  float Square;  ///< negative: the pixel does not count
  float Scatter; ///< its square, times the number of pixels with the same error
};

/// Sum over pixels.
struct ErrorSum
{
  float Squares = 0.f;
  float Scatter = 0.f;
  int Count = 0;

  /// Returns the sum of the squared errors and its standard deviation: the fewer errors are independent, the more it
  /// scatters about its expectation.
  float GetBound() const { return this->Squares + std::sqrt(2.f * this->Scatter); }
};

/// Adds the errors of the pixels [low, high).
template <typename Error>
ErrorSum SumErrors(glm::ivec2 low, glm::ivec2 high, const Error& errorAt)
{
  ErrorSum sum;
  for (int y = low.y; y < high.y; ++y)
  {
    for (int x = low.x; x < high.x; ++x)
    {
      const PixelError error = errorAt(x, y);
      if (error.Square >= 0.f)
      {
        sum.Squares += error.Square;
        sum.Scatter += error.Scatter;
        ++sum.Count;
      }
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

/// Increases the targets of pixels in the tile [first, end) if the bound of the mean of its squared errors exceeds
/// `limit`. Returns true if it has increased any. errorAt(x, y): PixelError.
// Numbers of rays in proportion to the errors of blocks of pixels would lead to the smallest error of the
// tile (Neyman allocation) if neighbors did not share their rays. They grow by the mean of this and of
// the same factor in the whole tile.
template <int N, typename Error>
bool IncreaseTile(
  SiteGrid<N>& grid, glm::ivec2 first, glm::ivec2 end, float limit, const Error& errorAt)
{
  const ErrorSum tile = SumErrors(first, end, errorAt);
  const float excess = tile.GetBound() / (static_cast<float>(tile.Count) * limit);
  if (!(excess > 1.f))
  {
    return false;
  }
  bool isIncreased = false;
  for (int i = 0; i < RayBlocks * RayBlocks; ++i)
  {
    const glm::ivec2 low = first + RayBlockSide * glm::ivec2(i % RayBlocks, i / RayBlocks);
    const glm::ivec2 high = glm::min(low + RayBlockSide, end);
    const ErrorSum block = SumErrors(low, high, errorAt);
    const float share = block.Squares * static_cast<float>(tile.Count) /
      (tile.Squares * static_cast<float>(block.Count));
    isIncreased |=
      block.Count > 0 && IncreaseBlock(grid, low, high, 0.5f * (1.f + std::sqrt(share)) * excess);
  }
  return isIncreased;
}

}
#endif
