// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Thickness.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace penumbra
{

namespace
{

/// Every so many pixels in both directions are looked at.
constexpr int Stride = 4;

/// Depths of neighbours that differ by more than this many pixel widths belong to two things.
constexpr float Jump = 8.f;

/// A line of pixels through the picture.
struct Line
{
  std::size_t Start;
  std::size_t Step;
  int Count;
};

/// Writes the width of every stretch that lies before what is on both of its sides.
void MeasureLine(const std::vector<float>& depths, const Line& line, double pixelWidth,
  bool parallel, std::vector<float>& widths)
{
  const auto at = [&](int k) { return depths[line.Start + k * line.Step]; };
  const auto widthAt = [&](int k) {
    return static_cast<float>(parallel ? pixelWidth : pixelWidth * at(k));
  };
  int first = 0;
  bool outlined = false;
  float width = 0.f;
  for (int k = 0; k + 1 < line.Count; ++k)
  {
    width += widthAt(k);
    const bool nearer = at(k) < at(k + 1);
    if (std::abs(at(k) - at(k + 1)) > Jump * widthAt(nearer ? k : k + 1))
    {
      for (int inside = first; outlined && nearer && inside <= k; ++inside)
      {
        widths[line.Start + inside * line.Step] = width;
      }
      first = k + 1;
      outlined = !nearer;
      width = 0.f;
    }
  }
}

}

double MedianWidth(const std::vector<float>& eyeDepths, const ScreenTransform& view)
{
  constexpr float none = 1e30f;
  const auto width = static_cast<std::size_t>(view.Width);
  const double pixelWidth = std::abs(view.Scale[0]) / (view.Parallel ? view.Unit : 1.0);
  const double pixelHeight = std::abs(view.Scale[1]) / (view.Parallel ? view.Unit : 1.0);
  std::vector<float> alongRows(eyeDepths.size(), none);
  std::vector<float> alongColumns(eyeDepths.size(), none);
  for (int j = 0; j < view.Height; j += Stride)
  {
    MeasureLine(eyeDepths, { j * width, 1, view.Width }, pixelWidth, view.Parallel, alongRows);
  }
  for (int i = 0; i < view.Width; i += Stride)
  {
    MeasureLine(eyeDepths, { static_cast<std::size_t>(i), width, view.Height }, pixelHeight,
      view.Parallel, alongColumns);
  }
  std::vector<float> found;
  for (int j = 0; j < view.Height; j += Stride)
  {
    for (int i = 0; i < view.Width; i += Stride)
    {
      const float shorter = std::min(alongRows[j * width + i], alongColumns[j * width + i]);
      if (shorter < none)
      {
        found.push_back(shorter);
      }
    }
  }
  if (found.empty())
  {
    return 0.0;
  }
  const auto middle = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
  std::nth_element(found.begin(), middle, found.end());
  return *middle;
}

}
