// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ExactCoverage.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

ExactCoverage::ExactCoverage(int width, int height)
  : Width(width),
    Height(height),
    Changes(static_cast<std::size_t>(width + 2) * height, 0.0)
{
}

void ExactCoverage::AddPolygon(const std::vector<glm::dvec2>& polygon)
{
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    this->AddEdge(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
}

// Adds the coverage to the right of an edge: +1 for a descending edge, -1 for an ascending one.
void ExactCoverage::AddEdge(glm::dvec2 from, glm::dvec2 to)
{
  const double low = std::max(std::min(from.y, to.y), 0.0);
  const double high = std::min(std::max(from.y, to.y), static_cast<double>(this->Height));
  const double sign = from.y > to.y ? 1.0 : -1.0;
  const auto xAt = [&](double y) {
    return from.x + (to.x - from.x) * ((y - from.y) / (to.y - from.y));
  };
  for (double y = low; y < high;)
  {
    const int row = static_cast<int>(y);
    const double next = std::min(row + 1.0, high);
    this->AddInRow(row, xAt(y), xAt(next), sign * (next - y));
    y = next;
  }
}

void ExactCoverage::AddInRow(int row, double fromX, double toX, double rise)
{
  double* changes = this->Changes.data() + static_cast<std::size_t>(this->Width + 2) * row;
  const double left = std::clamp(std::min(fromX, toX), 0.0, static_cast<double>(this->Width));
  const double right = std::clamp(std::max(fromX, toX), 0.0, static_cast<double>(this->Width));
  const double span = std::abs(toX - fromX);
  if (span == 0.0)
  {
    const int column = static_cast<int>(left);
    changes[column] += rise * (column + 1.0 - left);
    changes[column + 1] += rise * (left - column);
    return;
  }
  // Parts left of the image cover entire rows; parts right of it cover nothing.
  const double start = std::min(fromX, toX);
  changes[0] += rise * std::max(0.0, std::min(std::max(fromX, toX), 0.0) - start) / span;
  for (double x = left; x < right;)
  {
    const int column = static_cast<int>(x);
    const double next = std::min(column + 1.0, right);
    const double part = rise * (next - x) / span;
    const double middle = 0.5 * (x + next);
    changes[column] += part * (column + 1.0 - middle);
    changes[column + 1] += part * (middle - column);
    x = next;
  }
}

std::vector<double> ExactCoverage::GetShares() const
{
  std::vector<double> shares(static_cast<std::size_t>(this->Width) * this->Height);
  for (int j = 0; j < this->Height; ++j)
  {
    const double* changes = this->Changes.data() + static_cast<std::size_t>(this->Width + 2) * j;
    double share = 0.0;
    for (int i = 0; i < this->Width; ++i)
    {
      share += changes[i];
      shares[static_cast<std::size_t>(this->Width) * j + i] = share;
    }
  }
  return shares;
}

}
