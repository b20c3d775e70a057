// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "HemisphereRefinement.h"

#include "IrradianceConstants.h"
#include "Vectors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace penumbra
{
namespace
{

/// Returns the variance of a cell that a straight boundary cuts, between radiances that differ by
/// `step`: a fraction p of the cell is on one side, and p (1 - p) is 1/6 on average.
float ComputeStepVariance(float step)
{
  return step * step / 6.f;
}

float FindLargestDifference(const HemisphereSample& one, const HemisphereSample& other)
{
  return MaximumComponent(glm::abs(one.Radiance - other.Radiance));
}

/// Returns the distance at which the plane of `hit`, along `direction`, continues along `other`.
float ExtendPlane(const HemisphereSample& hit, glm::vec3 direction, glm::vec3 other)
{
  const float from = glm::dot(hit.Normal, direction);
  const float to = glm::dot(hit.Normal, other);
  return hit.Distance * (from * to > 0.f ? std::min(from / to, MaximumEdgeFactor) : 1.f);
}

/// Returns the number of parts m along each side of a cell. m * m rays in a cell that a boundary
/// cuts reduce its variance to m^-3, so that m^5 in proportion to the variance is optimal.
int ComputeSubdivisions(double variance, double unit)
{
  const int m = static_cast<int>(std::pow(variance / unit, .2) + .5);
  return std::clamp(m, 1, MaximumSubdivisions);
}

class Refinement
{
public:
  Refinement(const Gatherer& gatherer, SampledHemisphere& hemisphere)
    : Source(gatherer),
      Hemisphere(hemisphere),
      Random(HashPoint(hemisphere.Position, -hemisphere.Frame[2])),
      Subdivisions(hemisphere.Samples.size(), 1)
  {
  }

  /// Chooses the cells whose estimated variances are largest, for a sum of variances of `allowed`.
  void ChooseCells(const std::vector<EmitterSample>& emitterSamples, double allowed)
  {
    const std::vector<float> variances = this->EstimateVariances(emitterSamples);
    const double maximum = MaximumRayFactor * static_cast<double>(variances.size());
    double unit = *std::max_element(variances.begin(), variances.end());
    this->Unit = unit;
    while (unit > 0.0)
    {
      double rays = 0.0;
      double sum = 0.0;
      std::vector<int> parts(variances.size());
      for (std::size_t i = 0; i < variances.size(); ++i)
      {
        parts[i] = ComputeSubdivisions(variances[i], unit);
        rays += parts[i] > 1 ? parts[i] * parts[i] : 0;
        sum += variances[i] / std::pow(parts[i], 3.0);
      }
      if (rays > maximum)
      {
        break;
      }
      this->Subdivisions = std::move(parts);
      this->Unit = unit;
      if (sum <= allowed)
      {
        break;
      }
      unit *= .5;
    }
    for (int cell = 0; cell < this->Hemisphere.Grid.Cells(); ++cell)
    {
      if (this->Subdivisions[cell] > 1)
      {
        this->Chosen.push_back(cell);
      }
    }
  }

  /// Traces the rays of the chosen cells, and chooses the cells next to them where the nearest of
  /// these rays differ from the sample there. Without these cells, the light of what few first rays
  /// hit would be missing.
  void TraceRays()
  {
    std::vector<glm::vec3> directions;
    for (const int cell : this->Chosen)
    {
      this->Hemisphere.Grid.SubsampleCell(cell, this->Subdivisions[cell], this->Random, directions);
    }
    for (glm::vec3& direction : directions)
    {
      direction = this->Hemisphere.Frame * direction;
    }
    std::vector<HemisphereSample> refined;
    this->Rays +=
      this->Source.Gather(this->Hemisphere.Position, this->Hemisphere.Normals, directions, refined);
    const HemisphereSample* first = refined.data();
    for (const int cell : this->Chosen)
    {
      first += this->Average(cell, first, &directions[first - refined.data()]);
    }
    std::vector<int> next;
    first = refined.data();
    for (const int cell : this->Chosen)
    {
      this->ChooseNeighbors(cell, first, next);
      first += this->Subdivisions[cell] * this->Subdivisions[cell];
    }
    this->Chosen = std::move(next);
  }

  bool HasCells() const { return !this->Chosen.empty(); }
  long long GetRays() const { return this->Rays; }

private:
  /// Calls work(neighbor, direction) for the cells next to `cell`. Directions are -x, +x, -y, +y.
  template <typename Work>
  void ForEachNeighbor(int cell, const Work& work) const
  {
    const int side = this->Hemisphere.Grid.Side;
    const glm::ivec2 at(cell % side, cell / side);
    const std::array<glm::ivec2, 4> steps{ { { -1, 0 }, { 1, 0 }, { 0, -1 }, { 0, 1 } } };
    for (std::size_t k = 0; k < steps.size(); ++k)
    {
      const glm::ivec2 other = at + steps[k];
      if (other == glm::clamp(other, glm::ivec2(0), glm::ivec2(side - 1)))
      {
        work(other.y * side + other.x, steps[k]);
      }
    }
  }

  /// Estimates the variance of the single sample of each cell from its neighbors.
  std::vector<float> EstimateVariances(const std::vector<EmitterSample>& emitterSamples) const
  {
    const std::vector<HemisphereSample>& samples = this->Hemisphere.Samples;
    std::vector<float> variances(samples.size());
    for (int cell = 0; cell < this->Hemisphere.Grid.Cells(); ++cell)
    {
      float maximum = 0.f;
      this->ForEachNeighbor(cell, [&](int other, glm::ivec2) {
        maximum = std::max(maximum, FindLargestDifference(samples[other], samples[cell]));
      });
      variances[cell] = ComputeStepVariance(maximum);
    }
    for (const EmitterSample& emitterSample : emitterSamples)
    {
      this->RaiseVarianceNearEmitter(emitterSample, variances);
    }
    return variances;
  }

  /// Raises the variance of the cells around an emitter, because it may be visible there even if no
  /// ray hit it. Without this, the rays of small emitters would depend on chance hits and such
  /// emitters would be too dark on average.
  void RaiseVarianceNearEmitter(
    const EmitterSample& emitterSample, std::vector<float>& variances) const
  {
    const HemisphereGrid& grid = this->Hemisphere.Grid;
    const int cell =
      grid.FindCell(glm::transpose(this->Hemisphere.Frame) * emitterSample.Direction);
    if (cell < 0)
    {
      return;
    }
    const glm::ivec2 center(cell % grid.Side, cell / grid.Side);
    const glm::ivec2 low = glm::max(center - 1, 0);
    const glm::ivec2 high = glm::min(center + 1, grid.Side - 1);
    for (int j = low.y; j <= high.y; ++j)
    {
      for (int i = low.x; i <= high.x; ++i)
      {
        float& variance = variances[j * grid.Side + i];
        variance = std::max(variance, ComputeStepVariance(emitterSample.Strength));
      }
    }
  }

  /// Chooses neighbors that have a single sample, by the difference of this from the rays of `cell`
  /// at the common side. `first` is the first of these rays.
  void ChooseNeighbors(int cell, const HemisphereSample* first, std::vector<int>& next)
  {
    const int m = this->Subdivisions[cell];
    this->ForEachNeighbor(cell, [&](int other, glm::ivec2 step) {
      if (this->Hemisphere.Samples[other].Variance < 1.f)
      {
        return;
      }
      float maximum = 0.f;
      for (int k = 0; k < m; ++k)
      {
        const int i = step.x < 0 ? 0 : step.x > 0 ? m - 1 : k;
        const int j = step.y < 0 ? 0 : step.y > 0 ? m - 1 : k;
        maximum = std::max(
          maximum, FindLargestDifference(first[j * m + i], this->Hemisphere.Samples[other]));
      }
      const int parts = ComputeSubdivisions(ComputeStepVariance(maximum), this->Unit);
      if (parts > 1 && this->Subdivisions[other] == 1)
      {
        next.push_back(other);
      }
      this->Subdivisions[other] = std::max(this->Subdivisions[other], parts);
    });
  }

  /// Averages the rays from `first` with `directions` into the sample of `cell`. Returns their number.
  /// The sample keeps the hit of its single ray: that of a nearer surface would move the light of what
  /// is behind it to this distance.
  int Average(int cell, const HemisphereSample* first, const glm::vec3* directions)
  {
    const int count = this->Subdivisions[cell] * this->Subdivisions[cell];
    HemisphereSample& sample = this->Hemisphere.Samples[cell];
    const int nearest =
      static_cast<int>(std::min_element(first, first + count,
                         [](const HemisphereSample& one, const HemisphereSample& other) {
                           return one.Distance < other.Distance;
                         }) -
        first);
    if (std::isinf(sample.Distance) && !std::isinf(first[nearest].Distance))
    {
      sample.Normal = first[nearest].Normal;
      sample.Distance =
        ExtendPlane(first[nearest], directions[nearest], this->Hemisphere.Directions[cell]);
    }
    sample.Radiance = glm::vec3(0.f);
    for (int k = 0; k < count; ++k)
    {
      sample.Radiance += first[k].Radiance / static_cast<float>(count);
    }
    sample.Variance = 1.f / static_cast<float>(count * this->Subdivisions[cell]);
    return count;
  }

  const Gatherer& Source;
  SampledHemisphere& Hemisphere;
  std::uint32_t Random;
  std::vector<int> Subdivisions; ///< along each side of each cell
  std::vector<int> Chosen;       ///< cells whose rays are not traced yet
  double Unit = 0.0;             ///< see ComputeSubdivisions()
  long long Rays = 0;
};

}

long long RefineHemisphere(const Gatherer& gatherer, SampledHemisphere& hemisphere,
  const std::vector<EmitterSample>& emitterSamples, double tolerance)
{
  Refinement refinement(gatherer, hemisphere);
  refinement.ChooseCells(emitterSamples, std::pow(tolerance * hemisphere.Grid.Cells(), 2.0));
  while (refinement.HasCells()) // each cell is chosen once at most
  {
    refinement.TraceRays();
  }
  return refinement.GetRays();
}

}
