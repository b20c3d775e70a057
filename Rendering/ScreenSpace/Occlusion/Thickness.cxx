// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Thickness.h"

#include "Frame/ScreenSpaceConstants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace penumbra
{

namespace
{

/// A row or column of pixels.
struct Line
{
  std::size_t Start;
  std::size_t Step;
  int Count;
};

/// Writes the width of every segment of a line that is in front of the surfaces on both sides.
void MeasureLine(const std::vector<float>& depths, const Line& line, double pixelWidth,
  bool parallel, std::vector<float>& widths)
{
  const auto at = [&](int k) { return depths[line.Start + k * line.Step]; };
  const auto widthAt = [&](int k) {
    return static_cast<float>(parallel ? pixelWidth : pixelWidth * at(k));
  };
  int start = 0;
  bool hasOutline = false;
  float width = 0.f;
  for (int k = 0; k + 1 < line.Count; ++k)
  {
    width += widthAt(k);
    const bool isNearer = at(k) < at(k + 1);
    if (std::abs(at(k) - at(k + 1)) > DepthDiscontinuity * widthAt(isNearer ? k : k + 1))
    {
      for (int pixel = start; hasOutline && isNearer && pixel <= k; ++pixel)
      {
        widths[line.Start + pixel * line.Step] = width;
      }
      start = k + 1;
      hasOutline = !isNearer;
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
  for (int j = 0; j < view.Height; j += ThicknessPixelStride)
  {
    MeasureLine(eyeDepths, { j * width, 1, view.Width }, pixelWidth, view.Parallel, alongRows);
  }
  for (int i = 0; i < view.Width; i += ThicknessPixelStride)
  {
    MeasureLine(eyeDepths, { static_cast<std::size_t>(i), width, view.Height }, pixelHeight,
      view.Parallel, alongColumns);
  }
  std::vector<float> widths;
  for (int j = 0; j < view.Height; j += ThicknessPixelStride)
  {
    for (int i = 0; i < view.Width; i += ThicknessPixelStride)
    {
      const float shorterWidth = std::min(alongRows[j * width + i], alongColumns[j * width + i]);
      if (shorterWidth < none)
      {
        widths.push_back(shorterWidth);
      }
    }
  }
  if (widths.empty())
  {
    return 0.0;
  }
  const auto median = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
  std::nth_element(widths.begin(), median, widths.end());
  return *median;
}

}
