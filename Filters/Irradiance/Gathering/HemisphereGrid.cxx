// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "HemisphereGrid.h"

#include "Shading/HemisphereSampling.h"

#include <array>
#include <memory>
#include <mutex>

namespace penumbra
{
namespace
{

/// Number of integration points along each side of a cell.
constexpr int IntegrationPoints = 8;

/// Integration point along one side of a cell, in disk coordinates [0, 1].
struct Abscissa
{
  float At;
  float Weight;
};

/// Solid angle per disk area diverges at the edge of the disk like 1 / sqrt(1 - a^2), with a in
/// [-1, 1]. The substitution a = sin t removes the singularity.
std::array<Abscissa, IntegrationPoints> ComputeAbscissas(int cell, int side)
{
  const double low = std::asin(2.0 * cell / side - 1.0);
  const double high = std::asin(std::min(2.0 * (cell + 1) / side - 1.0, 1.0));
  const double step = (high - low) / IntegrationPoints;
  std::array<Abscissa, IntegrationPoints> points;
  for (int k = 0; k < IntegrationPoints; ++k)
  {
    const double t = low + (k + .5) * step;
    points[k] = { static_cast<float>(.5 * std::sin(t) + .5),
      static_cast<float>(.5 * std::cos(t) * step) };
  }
  return points;
}

glm::vec2 IntegrateTangent(int i, int j, int side)
{
  glm::vec2 sum(0.f);
  for (const Abscissa& u : ComputeAbscissas(i, side))
  {
    for (const Abscissa& v : ComputeAbscissas(j, side))
    {
      const glm::vec3 direction = DiskToHemisphere(SampleUniformDiskConcentric(u.At, v.At));
      // Solid angle is disk area over the cosine.
      sum += glm::vec2(direction) * (u.Weight * v.Weight / std::max(direction.z, 1e-6f));
    }
  }
  return sum;
}

std::unique_ptr<HemisphereGrid> MakeGrid(int side)
{
  auto grid = std::make_unique<HemisphereGrid>();
  grid->Side = side;
  const auto length = static_cast<float>(side);
  for (int j = 0; j <= side; ++j)
  {
    for (int i = 0; i <= side; ++i)
    {
      grid->Corners.push_back(DiskToHemisphere(SampleUniformDiskConcentric(
        static_cast<float>(i) / length, static_cast<float>(j) / length)));
    }
  }
  for (int cell = 0; cell < grid->Cells(); ++cell)
  {
    grid->NormalDerivatives.push_back(IntegrateTangent(cell % side, cell / side, side));
  }
  return grid;
}

}

const HemisphereGrid& HemisphereGrid::Get(int side)
{
  static std::mutex mutex;
  static std::array<std::unique_ptr<HemisphereGrid>, MaximumSide + 1> grids;
  const std::lock_guard<std::mutex> lock(mutex);
  std::unique_ptr<HemisphereGrid>& grid = grids[side];
  if (!grid)
  {
    grid = MakeGrid(side);
  }
  return *grid;
}

void HemisphereGrid::JitterDirections(std::uint32_t seed, std::vector<glm::vec3>& directions) const
{
  directions.resize(this->Cells());
  const auto length = static_cast<float>(this->Side);
  for (int j = 0; j < this->Side; ++j)
  {
    for (int i = 0; i < this->Side; ++i)
    {
      const float u = (static_cast<float>(i) + NextFloat(seed)) / length;
      const float v = (static_cast<float>(j) + NextFloat(seed)) / length;
      directions[j * this->Side + i] = DiskToHemisphere(SampleUniformDiskConcentric(u, v));
    }
  }
}

void HemisphereGrid::SubsampleCell(
  int cell, int subdivisions, std::uint32_t& random, std::vector<glm::vec3>& directions) const
{
  const auto length = static_cast<float>(this->Side * subdivisions);
  for (int k = 0; k < subdivisions * subdivisions; ++k)
  {
    const int i = cell % this->Side * subdivisions + k % subdivisions;
    const int j = cell / this->Side * subdivisions + k / subdivisions;
    const float u = (static_cast<float>(i) + NextFloat(random)) / length;
    const float v = (static_cast<float>(j) + NextFloat(random)) / length;
    directions.push_back(DiskToHemisphere(SampleUniformDiskConcentric(u, v)));
  }
}

int HemisphereGrid::FindCell(glm::vec3 direction) const
{
  if (direction.z < 0.f)
  {
    return -1;
  }
  const glm::ivec2 at(
    InvertUniformDiskConcentric(glm::vec2(direction)) * static_cast<float>(this->Side));
  const glm::ivec2 in = glm::clamp(at, glm::ivec2(0), glm::ivec2(this->Side - 1));
  return in.y * this->Side + in.x;
}

}
