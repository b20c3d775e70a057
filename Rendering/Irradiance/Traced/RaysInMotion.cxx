// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RaysInMotion.h"

#include "Frame/BackgroundDepth.h"

#include <algorithm>

namespace penumbra
{

namespace
{

/// Largest number of rays of a pixel, and number of samples that suffice.
constexpr int MaximumRays = 32;

/// Samples that a short history may lack, so that a pixel of a slowly zooming view, whose samples become
/// fewer by a fraction per frame, does not get a ray in each.
constexpr float AcceptedLack = 0.5f;

/// Side of the blocks of pixels of which one is traced per frame in a sparse frame. The phases go
/// around the block diagonally first.
constexpr int Step = 2;
static_assert(MotionPhases == Step * Step);
constexpr int PhaseColumn[MotionPhases] = { 0, 1, 1, 0 };
constexpr int PhaseRow[MotionPhases] = { 0, 1, 0, 1 };

/// Number of rays that complete `samples` samples to `wanted`. Pixels with a history then have more than
/// `wanted`, so that they differ from those without.
int CountMissingRays(float samples, int wanted)
{
  return samples < static_cast<float>(wanted) - AcceptedLack
    ? std::min(static_cast<int>(static_cast<float>(wanted) - samples) + 1, wanted)
    : 0;
}

template <typename Function>
void VisitSurfacePixels(const std::vector<float>& depths, int width,
  const std::vector<Rectangle>& parts, const Function& function)
{
  for (const Rectangle& part : parts)
  {
    for (int y = part.Y; y < part.Y + part.Height; ++y)
    {
      for (int x = part.X; x < part.X + part.Width; ++x)
      {
        const std::size_t pixel = static_cast<std::size_t>(y) * width + x;
        if (depths[pixel] < BackgroundDepth)
        {
          function(x, y, pixel);
        }
      }
    }
  }
}

}

void DistributeRays(const std::vector<float>& depths, std::vector<float>& history, int width,
  const std::vector<Rectangle>& parts, const MotionRayLimits& limits, RaysInMotion& result)
{
  double pixels = 0.0;
  double bySamples[MaximumRays] = {}; // number of pixels with fewer than MaximumRays samples
  VisitSurfacePixels(depths, width, parts, [&](int, int, std::size_t pixel) {
    ++pixels;
    const float samples = history[2 * pixel + 1];
    if (samples < MaximumRays)
    {
      ++bySamples[static_cast<int>(samples)];
    }
  });
  const auto countMissing = [&](int wanted) {
    double rays = 0.0;
    for (int samples = 0; samples < wanted; ++samples)
    {
      rays += bySamples[samples] * (wanted - samples);
    }
    return rays;
  };
  result.PerPixel = result.WithoutHistory = std::clamp(limits.PerPixel, 1, 1 << 15);
  const double sparse = limits.Sparse ? 1.0 / MotionPhases : 1.0;
  while (result.WithoutHistory < MaximumRays &&
    countMissing(result.WithoutHistory + 1) + sparse * pixels * result.PerPixel <=
      limits.Affordable)
  {
    ++result.WithoutHistory;
  }
  const double rest =
    limits.Affordable - countMissing(std::min(result.WithoutHistory, MaximumRays));
  result.IsSparse = limits.Sparse && rest < pixels * result.PerPixel;
  while (
    !result.IsSparse && result.PerPixel < MaximumRays && (result.PerPixel + 1) * pixels <= rest)
  {
    ++result.PerPixel;
  }
  result.LongHistory.assign(depths.size(), 0);
  result.ShortHistory.assign(depths.size(), 0);
  result.Traced.assign(depths.size(), 0);
  VisitSurfacePixels(depths, width, parts, [&](int x, int y, std::size_t pixel) {
    const int missing = CountMissingRays(history[2 * pixel + 1], result.WithoutHistory);
    const bool hasTurn = !result.IsSparse ||
      (x % Step == PhaseColumn[limits.Phase] && y % Step == PhaseRow[limits.Phase]);
    const int inTurn = hasTurn ? result.PerPixel : 0;
    (missing > 0 ? result.ShortHistory : result.LongHistory)[pixel] =
      static_cast<std::uint16_t>(std::max(missing, inTurn));
    result.Traced[pixel] = missing + inTurn > 0;
    history[2 * pixel + 1] += static_cast<float>(std::max(missing, inTurn));
  });
}

}
