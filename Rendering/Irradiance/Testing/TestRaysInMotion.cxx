// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/BackgroundDepth.h"
#include "Traced/RaysInMotion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

using namespace penumbra;

namespace
{

constexpr int Width = 8;
constexpr int Pixels = Width * Width;

/// Distributes the rays of an image whose lower half has `below` samples per pixel, the upper half 100.
RaysInMotion Distribute(float below, const MotionRayLimits& limits)
{
  std::vector<float> history(2 * Pixels, 100.f);
  for (int pixel = 0; pixel < Pixels / 2; ++pixel)
  {
    history[2 * pixel + 1] = below;
  }
  const std::vector<float> before = history;
  RaysInMotion rays;
  DistributeRays(
    std::vector<float>(Pixels, 1.f), history, Width, { { 0, 0, Width, Width } }, limits, rays);
  for (int pixel = 0; pixel < Pixels; ++pixel)
  {
    EXPECT_EQ(history[2 * pixel + 1],
      before[2 * pixel + 1] +
        static_cast<float>(rays.LongHistory[pixel] + rays.ShortHistory[pixel]));
  }
  return rays;
}

int Sum(const PixelRays& counts)
{
  return std::accumulate(counts.begin(), counts.end(), 0);
}

}

TEST(RaysInMotion, GoToAQuarterOfThePixelsWithHistoryAndToAllWithout)
{
  MotionRayLimits limits;
  std::vector<int> turns(Pixels, 0);
  for (limits.Phase = 0; limits.Phase < 4; ++limits.Phase)
  {
    const RaysInMotion rays = Distribute(0.f, limits);
    EXPECT_TRUE(rays.IsSparse);
    EXPECT_EQ(rays.WithoutHistory, 1);
    EXPECT_EQ(Sum(rays.ShortHistory), Pixels / 2);
    EXPECT_EQ(Sum(rays.LongHistory), Pixels / 8);
    for (int pixel = 0; pixel < Pixels; ++pixel)
    {
      turns[pixel] += rays.LongHistory[pixel];
      EXPECT_EQ(rays.Traced[pixel] != 0, rays.LongHistory[pixel] + rays.ShortHistory[pixel] > 0);
    }
  }
  EXPECT_EQ(std::count(turns.begin(), turns.end(), 1), Pixels / 2);
  limits.Sparse = false;
  EXPECT_EQ(Sum(Distribute(100.f, limits).LongHistory), Pixels);
}

TEST(RaysInMotion, CompleteShortHistoriesAsFarAsAffordable)
{
  MotionRayLimits limits;
  limits.Affordable = Pixels / 4 + 7 * Pixels / 2; // 7 rays per pixel without history
  EXPECT_EQ(Distribute(0.f, limits).WithoutHistory, 7);
  EXPECT_EQ(Sum(Distribute(0.f, limits).ShortHistory), 7 * Pixels / 2);
  // Pixels with 4.2 samples get them up to more than 11, whose rays are as many.
  const RaysInMotion rays = Distribute(4.2f, limits);
  EXPECT_EQ(rays.WithoutHistory, 11);
  EXPECT_EQ(rays.ShortHistory[0], 7);
  EXPECT_EQ(rays.ShortHistory[Pixels - 1], 0);
  // If all histories are long, the rays go to all pixels.
  const RaysInMotion dense = Distribute(100.f, limits);
  EXPECT_FALSE(dense.IsSparse);
  EXPECT_EQ(Sum(dense.LongHistory), 3 * Pixels);
}

TEST(RaysInMotion, SkipTheBackgroundAndOtherParts)
{
  std::vector<float> depths(Pixels, 1.f);
  depths[3] = BackgroundDepth;
  std::vector<float> history(2 * Pixels, 0.f);
  RaysInMotion rays;
  DistributeRays(depths, history, Width, { { 0, 0, 4, 1 } }, MotionRayLimits(), rays);
  EXPECT_EQ(Sum(rays.ShortHistory), 3);
  EXPECT_EQ(rays.ShortHistory[3], 0);
}
