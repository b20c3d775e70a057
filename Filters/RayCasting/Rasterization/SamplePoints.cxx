// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SamplePoints.h"

#include "Shading/HemisphereSampling.h"
#include "Shading/OwenSobolSequence.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>

namespace penumbra
{

namespace
{

/// Distance of samples from the sides of their pixel, so that rounding does not move them into its
/// neighbors.
constexpr float Inset = 1e-4f;
constexpr int FractionBits = 24;
constexpr int CellBits = 2;

/// Points with coordinates as multiples of 2^-24, sorted by cells.
struct Block
{
  std::vector<std::uint32_t> X;
  std::vector<std::uint32_t> Y;
  std::vector<std::uint32_t> Indices;

  Block(int first, int count)
    : X(count),
      Y(count),
      Indices(count)
  {
    const OwenSobolSequence sequence(0u);
    std::vector<glm::uvec2> points(count);
    for (int i = 0; i < count; ++i)
    {
      points[i] = glm::uvec2(
        sequence.At(static_cast<std::uint32_t>(first + i)) * static_cast<float>(1 << FractionBits));
    }
    std::iota(this->Indices.begin(), this->Indices.end(), 0u);
    const auto cell = [&](std::uint32_t i) {
      const glm::uvec2 c = points[i] >> glm::uvec2(FractionBits - CellBits);
      return c.y << CellBits | c.x;
    };
    std::stable_sort(this->Indices.begin(), this->Indices.end(),
      [&](std::uint32_t a, std::uint32_t b) { return cell(a) < cell(b); });
    for (int i = 0; i < count; ++i)
    {
      this->X[i] = points[this->Indices[i]].x;
      this->Y[i] = points[this->Indices[i]].y;
    }
  }
};

const Block& GetBlock(int first, int count)
{
  static const std::map<std::pair<int, int>, Block> blocks = [] {
    std::map<std::pair<int, int>, Block> all;
    for (int n = SamplePoints::MinimumCount; n <= SamplePoints::MaximumCount; n *= 2)
    {
      all.emplace(std::make_pair(0, n), Block(0, n));
      all.emplace(std::make_pair(n, n), Block(n, n));
    }
    return all;
  }();
  return blocks.at({ first, count });
}

}

void SamplePoints::Compute(std::uint32_t seed, int first, int count)
{
  const Block& block = GetBlock(first, count);
  this->X.resize(count);
  this->Y.resize(count);
  this->Indices.resize(count);
  const std::uint32_t shiftX = MixBits(seed) >> (32 - FractionBits);
  const std::uint32_t shiftY = MixBits(seed + 0x9e3779b9u) >> (32 - FractionBits);
  const std::size_t perCell = count / NumberOfCells;
  const std::uint32_t shiftedCell =
    (shiftY >> (FractionBits - CellBits)) << CellBits | shiftX >> (FractionBits - CellBits);
  constexpr float scale = (1.f - 2.f * Inset) / static_cast<float>(1 << FractionBits);
  for (std::uint32_t cell = 0; cell < NumberOfCells; ++cell)
  {
    const std::size_t from = (cell ^ shiftedCell) * perCell;
    const std::size_t to = cell * perCell;
    for (std::size_t i = 0; i < perCell; ++i)
    {
      this->X[to + i] =
        Inset + scale * static_cast<float>(static_cast<int>(block.X[from + i] ^ shiftX));
      this->Y[to + i] =
        Inset + scale * static_cast<float>(static_cast<int>(block.Y[from + i] ^ shiftY));
      this->Indices[to + i] = block.Indices[from + i];
    }
  }
}

}
