// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Thickness.h"

#include "Frame/ScreenSpaceConstants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace penumbra
{

namespace
{

/// Widths at every ThicknessPixelStride-th pixel in both directions.
class WidthGrid
{
public:
  WidthGrid(int width, int height)
    : Columns((width + ThicknessPixelStride - 1) / ThicknessPixelStride),
      Widths(static_cast<std::size_t>(this->Columns) *
          ((height + ThicknessPixelStride - 1) / ThicknessPixelStride),
        None)
  {
  }

  int GetNumberOfColumns() const { return this->Columns; }
  const std::vector<float>& GetWidths() const { return this->Widths; }

  /// Reduces the widths in a range of columns or rows, in grid points, to `width`.
  void LimitRow(int row, int first, int last, float width)
  {
    for (int column = first; column <= last; ++column)
    {
      this->Limit(row, column, width);
    }
  }
  void LimitColumn(int column, int first, int last, float width)
  {
    for (int row = first; row <= last; ++row)
    {
      this->Limit(row, column, width);
    }
  }

  static constexpr float None = 1e30f;

private:
  void Limit(int row, int column, float width)
  {
    float& value = this->Widths[static_cast<std::size_t>(row) * this->Columns + column];
    value = std::min(value, width);
  }

  int Columns;
  std::vector<float> Widths;
};

/// Progress along a row or column of pixels.
class LineSearch
{
public:
  /// Goes from pixel k to the next one. Calls `found(first, last, width)`, in grid points, at the end
  /// of a segment that is in front of the surfaces on both sides.
  template <typename Found>
  void Advance(int k, float depth, float next, double pixelWidth, bool parallel, const Found& found)
  {
    const auto widthAt = [&](float eyeDepth) {
      return static_cast<float>(parallel ? pixelWidth : pixelWidth * eyeDepth);
    };
    this->Width += widthAt(depth);
    const bool isNearer = depth < next;
    if (!(std::abs(depth - next) > DepthDiscontinuity * widthAt(isNearer ? depth : next)))
    {
      return;
    }
    if (this->HasOutline && isNearer)
    {
      found((this->Start + ThicknessPixelStride - 1) / ThicknessPixelStride,
        k / ThicknessPixelStride, this->Width);
    }
    this->Start = k + 1;
    this->HasOutline = !isNearer;
    this->Width = 0.f;
  }

private:
  int Start = 0;
  bool HasOutline = false;
  float Width = 0.f;
};

}

double MedianWidth(const std::vector<float>& eyeDepths, const ScreenTransform& view)
{
  const auto width = static_cast<std::size_t>(view.Width);
  const double pixelWidth = std::abs(view.Scale[0]) / (view.Parallel ? view.Unit : 1.0);
  const double pixelHeight = std::abs(view.Scale[1]) / (view.Parallel ? view.Unit : 1.0);
  WidthGrid grid(view.Width, view.Height);
  // All columns advance together, because the depths of a row are next to each other in memory.
  std::vector<LineSearch> columns(grid.GetNumberOfColumns());
  for (int j = 0; j < view.Height; ++j)
  {
    const float* row = eyeDepths.data() + j * width;
    if (j % ThicknessPixelStride == 0)
    {
      LineSearch search;
      for (int i = 0; i + 1 < view.Width; ++i)
      {
        search.Advance(
          i, row[i], row[i + 1], pixelWidth, view.Parallel, [&](int first, int last, float found) {
            grid.LimitRow(j / ThicknessPixelStride, first, last, found);
          });
      }
    }
    for (int column = 0; j + 1 < view.Height && column < grid.GetNumberOfColumns(); ++column)
    {
      const float* depth = row + column * ThicknessPixelStride;
      columns[column].Advance(j, depth[0], depth[width], pixelHeight, view.Parallel,
        [&](int first, int last, float found) { grid.LimitColumn(column, first, last, found); });
    }
  }
  std::vector<float> widths;
  std::copy_if(grid.GetWidths().begin(), grid.GetWidths().end(), std::back_inserter(widths),
    [](float found) { return found < WidthGrid::None; });
  if (widths.empty())
  {
    return 0.0;
  }
  const auto median = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
  std::nth_element(widths.begin(), median, widths.end());
  return *median;
}

void GradualThickness::Advance()
{
  // In ratios: a change from thin to thick takes as many frames as one from thick to thin.
  this->Current *= std::pow(this->Measured / this->Current, ThicknessStep);
}

}
