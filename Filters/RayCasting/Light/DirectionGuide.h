// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Directs rays to where the light of a block of pixels varies (importance sampling).
#ifndef penumbra_DirectionGuide_h
#define penumbra_DirectionGuide_h

#include "LightConstants.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace penumbra
{

/// Density of directions, relative to that by the cosine, on a grid of cells of the unit square. A part of it is in
/// proportion to the noise that the first rays show around each cell: the larger their contrast, the larger this part.
class DirectionGuide
{
  static constexpr int Cells = GuideSide * GuideSide;

public:
  /// Makes the uniform density.
  DirectionGuide()
    : DirectionGuide(Sums())
  {
  }

  /// Sums over the rays in each cell.
  struct Sums
  {
    std::array<float, Cells> Values{};
    std::array<float, Cells> Squares{};
    std::array<float, Cells> Counts{};

    /// Adds a ray in the direction of a point of the unit square, along which `value` arrives.
    void Add(glm::vec2 at, float value)
    {
      const glm::ivec2 cell = glm::min(glm::ivec2(at * float(GuideSide)), GuideSide - 1);
      const int i = cell.y * GuideSide + cell.x;
      this->Values[i] += value;
      this->Squares[i] += value * value;
      this->Counts[i] += 1.f;
    }
  };

  explicit DirectionGuide(const Sums& sums)
  {
    float total = 0.f;
    float squares = 0.f;
    for (int i = 0; i < Cells; ++i)
    {
      this->Densities[i] = EstimateNoise(sums, { i % GuideSide, i / GuideSide });
      total += this->Densities[i];
      squares += this->Densities[i] * this->Densities[i];
    }
    const float mean = total / Cells;
    const bool isGuided = squares > 0.f && std::isfinite(squares);
    const float unguided = isGuided ? std::max(mean * total / squares, UnguidedFraction) : 1.f;
    for (int i = 0; i < Cells; ++i)
    {
      const float guided = isGuided ? this->Densities[i] / mean : 1.f;
      this->Densities[i] = unguided + (1.f - unguided) * guided;
      this->Rows[i / GuideSide] += this->Densities[i];
    }
  }

  /// Moves a point of the unit square such that uniform points get this density. Returns the weight of its ray, at most
  /// 1 / UnguidedFraction.
  float Move(glm::vec2& at) const
  {
    const float* const cells = this->Densities.data() + GuideSide * Choose(this->Rows.data(), at.y);
    return 1.f / cells[Choose(cells, at.x)];
  }

private:
  /// Returns the standard deviation of the values in a cell and its neighbors, of which each has few rays. A part of
  /// the mean is added.
  static float EstimateNoise(const Sums& sums, glm::ivec2 cell)
  {
    const glm::ivec2 low = glm::max(cell - 1, 0);
    const glm::ivec2 high = glm::min(cell + 1, GuideSide - 1);
    float values = 0.f;
    float squares = 0.f;
    float count = 0.f;
    for (int y = low.y; y <= high.y; ++y)
    {
      for (int x = low.x; x <= high.x; ++x)
      {
        values += sums.Values[y * GuideSide + x];
        squares += sums.Squares[y * GuideSide + x];
        count += sums.Counts[y * GuideSide + x];
      }
    }
    const float mean = count > 0.f ? values / count : 0.f;
    const float variance = count > 0.f ? std::max(squares / count - mean * mean, 0.f) : 0.f;
    return std::sqrt(variance + GuideMeanPart * mean * mean);
  }

  /// Chooses one of GuideSide intervals in proportion to their densities by a number in [0, 1), and replaces this by
  /// the corresponding coordinate in the interval.
  static int Choose(const float* densities, float& at)
  {
    float sum = 0.f;
    for (int i = 0; i < GuideSide; ++i)
    {
      sum += densities[i];
    }
    float rest = at * sum;
    int chosen = 0;
    while (chosen + 1 < GuideSide && rest >= densities[chosen])
    {
      rest -= densities[chosen++];
    }
    constexpr float BelowOne = 1.f - 0x1p-20f;
    at = (static_cast<float>(chosen) + std::min(rest / densities[chosen], BelowOne)) / GuideSide;
    return chosen;
  }

  std::array<float, Cells> Densities{};
  std::array<float, GuideSide> Rows{};
};

}
#endif
