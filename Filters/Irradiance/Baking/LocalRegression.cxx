// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LocalRegression.h"

#include "Gathering/IrradianceConstants.h"
#include "Shading/HemisphereSampling.h"

#include <algorithm>

namespace penumbra
{
LocalRegression::LocalRegression(const std::vector<RecordCandidate>& sites,
  const std::vector<std::size_t>& which, float spacing, float radius)
  : Sites(sites),
    Radius(std::max(radius * spacing, 1e-30f))
{
  std::vector<std::pair<std::uint64_t, std::size_t>> keyed;
  for (const std::size_t index : which)
  {
    keyed.emplace_back(ComputeKey(this->FindCell(sites[index].Position)), index);
  }
  std::sort(keyed.begin(), keyed.end());
  for (const auto& [key, index] : keyed)
  {
    const std::size_t at = this->Order.size();
    const auto cell = this->Cells.emplace(key, std::make_pair(at, at)).first;
    cell->second.second = at + 1;
    this->Order.push_back(index);
  }
}

std::array<std::int64_t, 3> LocalRegression::FindCell(glm::vec3 position) const
{
  const glm::dvec3 cell = glm::floor(glm::dvec3(position) / static_cast<double>(this->Radius));
  return { static_cast<std::int64_t>(cell.x), static_cast<std::int64_t>(cell.y),
    static_cast<std::int64_t>(cell.z) };
}

std::uint64_t LocalRegression::ComputeKey(const std::array<std::int64_t, 3>& cell)
{
  // Distant cells may have the same key: their points are rejected by distance.
  constexpr std::uint64_t Mask = (1u << 21) - 1;
  return (static_cast<std::uint64_t>(cell[0]) & Mask) << 42 |
    (static_cast<std::uint64_t>(cell[1]) & Mask) << 21 |
    (static_cast<std::uint64_t>(cell[2]) & Mask);
}

void LocalRegression::FindRows(
  std::size_t index, const std::vector<NoisyEstimate>& estimates, std::vector<Row>& rows) const
{
  const RecordCandidate& site = this->Sites[index];
  const glm::mat3 frame = FrameFromNormal(site.Normal);
  const std::array<std::int64_t, 3> center = this->FindCell(site.Position);
  rows.clear();
  const auto add = [&](std::size_t which) {
    const RecordCandidate& other = this->Sites[which];
    const glm::vec3 d = (other.Position - site.Position) / this->Radius;
    const float square = glm::dot(d, d);
    if (square < 1.f && glm::dot(other.Normal, site.Normal) > RegressionCosine &&
      !site.IsOffPlane(other))
    {
      rows.push_back({ { 1.0, glm::dot(d, frame[0]), glm::dot(d, frame[1]),
                         glm::dot(other.Normal, frame[0]), glm::dot(other.Normal, frame[1]) },
        1.0 - square, estimates[which] });
    }
  };
  for (int k = 0; k < 27; ++k)
  {
    const auto found = this->Cells.find(
      ComputeKey({ center[0] + k % 3 - 1, center[1] + k / 3 % 3 - 1, center[2] + k / 9 - 1 }));
    if (found == this->Cells.end())
    {
      continue;
    }
    // Use a subset of the points of a crowded cell.
    const auto [first, last] = found->second;
    const std::size_t step = (last - first + MaximumPointsPerCell - 1) / MaximumPointsPerCell;
    for (std::size_t at = first; at < last; at += step)
    {
      add(this->Order[at]);
    }
    // Make sure that the subset includes the point itself. Points of a cell are sorted by index.
    const auto begin = this->Order.begin() + static_cast<std::ptrdiff_t>(first);
    const auto self =
      std::lower_bound(begin, begin + static_cast<std::ptrdiff_t>(last - first), index);
    const auto position = static_cast<std::size_t>(self - begin);
    if (step > 1 && position < last - first && *self == index && position % step != 0)
    {
      add(index);
    }
  }
  float variance = 0.f;
  for (const Row& row : rows)
  {
    variance += row.Estimate.Error * row.Estimate.Error / static_cast<float>(rows.size());
  }
  for (Row& row : rows)
  {
    const float sampleVariance = row.Estimate.Error * row.Estimate.Error;
    row.Weight *=
      variance > 0.f ? variance / (sampleVariance + CommonVarianceFraction * variance) : 1.f;
  }
}

NoisyEstimate LocalRegression::Fit(
  std::size_t index, const std::vector<NoisyEstimate>& estimates) const
{
  thread_local std::vector<Row> rows; // reused to avoid allocations
  this->FindRows(index, estimates, rows);
  if (rows.size() < Terms + MinimumSurplus)
  {
    return {};
  }
  // Normal equations of the least-squares fit with two right-hand sides: the estimates, for the
  // function, and the first unit vector, for the weight of each estimate in the fitted value.
  double m[Terms][Terms + 2] = {};
  double weights = 0.0;
  for (const Row& row : rows)
  {
    weights += row.Weight;
    for (int i = 0; i < Terms; ++i)
    {
      for (int j = 0; j <= i; ++j)
      {
        m[i][j] += row.Weight * row.Term[i] * row.Term[j];
      }
      m[i][Terms] += row.Weight * row.Term[i] * row.Estimate.Mean;
    }
  }
  for (int i = 1; i < Terms; ++i)
  {
    m[i][i] += Ridge * weights;
    for (int j = 0; j < i; ++j)
    {
      m[j][i] = m[i][j];
    }
  }
  m[0][Terms + 1] = 1.0;
  for (int pivot = 0; pivot < Terms; ++pivot) // positive definite: pivoting is not needed
  {
    for (int i = 0; i < Terms; ++i)
    {
      const double factor = i == pivot ? 0.0 : m[i][pivot] / m[pivot][pivot];
      for (int j = pivot; j < Terms + 2; ++j)
      {
        m[i][j] -= factor * m[pivot][j];
      }
    }
  }
  double residual = 0.0;
  double noise = 0.0;
  double variance = 0.0;
  for (const Row& row : rows)
  {
    double expected = 0.0;
    double weight = 0.0;
    for (int i = 0; i < Terms; ++i)
    {
      expected += m[i][Terms] / m[i][i] * row.Term[i];
      weight += m[i][Terms + 1] / m[i][i] * row.Term[i] * row.Weight;
    }
    const double sampleVariance = VarianceFactor * row.Estimate.Error * row.Estimate.Error;
    residual += row.Weight * (row.Estimate.Mean - expected) * (row.Estimate.Mean - expected);
    noise += row.Weight * sampleVariance;
    variance += weight * weight * sampleVariance;
  }
  const double degreesOfFreedom = 1.0 - Terms / static_cast<double>(rows.size());
  const double unexplained = std::max(0.0, (residual / degreesOfFreedom - noise) / weights);
  return { static_cast<float>(m[0][Terms] / m[0][0]),
    static_cast<float>(RegressionErrorFactor * std::sqrt(variance + unexplained)) };
}

}
