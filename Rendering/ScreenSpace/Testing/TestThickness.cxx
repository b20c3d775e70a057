// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The median width of visible objects against known widths, and against a search from every pixel.
#include "Frame/ScreenSpaceConstants.h"
#include "Occlusion/Thickness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <vector>

namespace
{

using namespace penumbra;

constexpr float Background = 100.f;

ScreenTransform MakeView(int width, int height, bool isParallel)
{
  ScreenTransform view;
  view.Width = width;
  view.Height = height;
  view.Parallel = isParallel;
  view.Scale[0] = 0.01;
  view.Scale[1] = 0.015;
  return view;
}

/// Sets the depth of a rectangle of pixels.
void Draw(std::vector<float>& depths, const ScreenTransform& view, int left, int bottom, int width,
  int height, float depth)
{
  for (int j = bottom; j < std::min(bottom + height, view.Height); ++j)
  {
    for (int i = left; i < std::min(left + width, view.Width); ++i)
    {
      depths[j * view.Width + i] = depth;
    }
  }
}

/// Returns the width of the object around pixel `k` of a line, searched in both directions.
std::optional<float> FindWidth(const std::vector<float>& line, int k, double size, bool isParallel)
{
  const auto sizeAt = [&](float depth) {
    return static_cast<float>(isParallel ? size : size * depth);
  };
  const auto isOutline = [&](int a) { // between pixels a and a + 1
    const float nearer = std::min(line[a], line[a + 1]);
    return std::abs(line[a] - line[a + 1]) > DepthDiscontinuity * sizeAt(nearer);
  };
  const int count = static_cast<int>(line.size());
  int first = k;
  while (first > 0 && !isOutline(first - 1))
  {
    --first;
  }
  int last = k;
  while (last + 1 < count && !isOutline(last))
  {
    ++last;
  }
  if (first == 0 || last + 1 == count || line[first - 1] < line[first] ||
    line[last + 1] < line[last])
  {
    return std::nullopt;
  }
  float width = 0.f;
  for (int i = first; i <= last; ++i)
  {
    width += sizeAt(line[i]);
  }
  return width;
}

/// The median by a search from every pixel that counts.
double FindMedianWidth(const std::vector<float>& depths, const ScreenTransform& view)
{
  std::vector<float> widths;
  for (int j = 0; j < view.Height; j += ThicknessPixelStride)
  {
    for (int i = 0; i < view.Width; i += ThicknessPixelStride)
    {
      const auto begin = depths.begin() + j * view.Width;
      const std::vector<float> row(begin, begin + view.Width);
      std::vector<float> column;
      for (int y = 0; y < view.Height; ++y)
      {
        column.push_back(depths[y * view.Width + i]);
      }
      const auto alongRow = FindWidth(row, i, view.Scale[0], view.Parallel);
      const auto alongColumn = FindWidth(column, j, view.Scale[1], view.Parallel);
      if (alongRow || alongColumn)
      {
        widths.push_back(std::min(alongRow.value_or(1e30f), alongColumn.value_or(1e30f)));
      }
    }
  }
  if (widths.empty())
  {
    return 0.0;
  }
  const auto middle = widths.begin() + static_cast<long>(widths.size() / 2);
  std::nth_element(widths.begin(), middle, widths.end());
  return *middle;
}

}

TEST(MedianWidth, IsThatOfARectangle)
{
  for (const bool isParallel : { false, true })
  {
    const ScreenTransform view = MakeView(80, 60, isParallel);
    std::vector<float> depths(80 * 60, Background);
    Draw(depths, view, 17, 9, 13, 40, 20.f); // 40 pixels high: the width along rows is shorter
    EXPECT_NEAR(MedianWidth(depths, view), 13 * 0.01 * (isParallel ? 1.0 : 20.0), 1e-5);
  }
}

TEST(MedianWidth, IgnoresWhatReachesTheBorder)
{
  const ScreenTransform view = MakeView(80, 60, false);
  std::vector<float> depths(80 * 60, Background);
  EXPECT_EQ(MedianWidth(depths, view), 0.0);
  Draw(depths, view, 60, 40, 20, 20, 20.f);
  EXPECT_EQ(MedianWidth(depths, view), 0.0);
}

TEST(MedianWidth, IgnoresWhatIsSeenThroughAHole)
{
  const ScreenTransform view = MakeView(80, 60, false);
  std::vector<float> depths(80 * 60, 20.f);
  Draw(depths, view, 20, 20, 20, 20, Background);
  EXPECT_EQ(MedianWidth(depths, view), 0.0);
}

TEST(MedianWidth, EqualsASearchFromEveryPixel)
{
  std::mt19937 random(1);
  const auto draw = [&random](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low));
  };
  for (int trial = 0; trial < 40; ++trial)
  {
    const ScreenTransform view = MakeView(draw(1, 120), draw(1, 90), trial % 2 == 1);
    std::vector<float> depths(static_cast<std::size_t>(view.Width) * view.Height, Background);
    for (int i = 0; i < 30; ++i)
    {
      Draw(depths, view, draw(0, view.Width), draw(0, view.Height), draw(1, 30), draw(1, 30),
        static_cast<float>(draw(10, 100)));
    }
    EXPECT_EQ(MedianWidth(depths, view), FindMedianWidth(depths, view)) << trial;
  }
}

TEST(GradualThickness, ApproachesAMeasurement)
{
  GradualThickness thickness;
  thickness.Set(0.1);
  thickness.Advance();
  EXPECT_DOUBLE_EQ(thickness.Get(), 0.1);
  thickness.Approach(1.0);
  EXPECT_DOUBLE_EQ(thickness.Get(), 0.1);
  double last = thickness.Get();
  for (int frame = 0; frame < FramesPerThickness; ++frame)
  {
    thickness.Advance();
    EXPECT_GT(thickness.Get(), last);
    EXPECT_LE(thickness.Get() / last, std::pow(10.0, ThicknessStep) + 1e-9);
    last = thickness.Get();
  }
  // A tenth of the ratio of 10 is left.
  EXPECT_NEAR(std::log10(1.0 / last), std::pow(1.0 - ThicknessStep, FramesPerThickness), 1e-9);
  EXPECT_LT(std::log10(1.0 / last), 0.11);
}
