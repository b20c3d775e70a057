// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraBruteForceSource.h"

#include "CosineDirections.h"
#include "RayScene.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkPenumbraBruteForceSource);

namespace
{

using penumbra::Ray;
using penumbra::RayScene;
using Estimate = vtkPenumbraIrradianceSource::Estimate;

/// Cells along a side of the first grid: 32 rays.
constexpr int FirstGrid = 4;

/// Even where all of n rays agree something may hide between them: its share is taken to be this
/// over n.
constexpr double HiddenShare = 0.25;

/// Cells on a border that are counted as differing whatever their rays say; measured by the test
/// ReportsAnErrorThatIsTrue.
constexpr double LuckAllowance = 3.0;

/// Asks rays above one point.
class Hemisphere
{
public:
  Hemisphere(const RayScene& rays, glm::vec3 point, glm::vec3 normal, float reach)
    : Rays(rays),
      Frame(penumbra::FrameOf(normal)),
      State(penumbra::SeedOf(point, normal))
  {
    this->Probe.Origin = point + penumbra::GapAbove(point) * normal;
    this->Probe.Far = reach;
  }

  /// One grid of `side` x `side` cells, two rays a cell.
  Estimate Ask(int side)
  {
    int blocked = 0;
    int differing = 0;
    for (int i = 0; i < side * side; ++i)
    {
      const bool first = this->IsBlocked(i % side, i / side, side);
      const bool second = this->IsBlocked(i % side, i / side, side);
      blocked += first + second;
      differing += first != second;
    }
    // A cell's mean of two has the variance (difference / 2)^2 by the two's own evidence. Where a
    // border is about, some cells that it crosses agree by chance; stopping on such luck would
    // make the reported error too small, hence the allowance.
    const double cells = static_cast<double>(side) * side;
    const bool border = blocked > 0 && blocked < 2 * side * side;
    Estimate result;
    result.Rays = 2LL * side * side;
    result.Value = blocked / (2.0 * cells);
    result.Error = std::sqrt((differing + (border ? LuckAllowance : 0.0)) * .25) / cells;
    return result;
  }

private:
  bool IsBlocked(int i, int j, int side)
  {
    const float u =
      (static_cast<float>(i) + penumbra::Uniform(this->State)) / static_cast<float>(side);
    const float v =
      (static_cast<float>(j) + penumbra::Uniform(this->State)) / static_cast<float>(side);
    this->Probe.Direction = this->Frame * penumbra::ToHemisphere(penumbra::ToDisc(u, v));
    return this->Rays.Occluded(this->Probe);
  }

  const RayScene& Rays;
  glm::mat3 Frame;
  Ray Probe;
  std::uint32_t State;
};

}

void vtkPenumbraBruteForceSource::Begin(
  const penumbra::RayScene& scene, double radius, double tolerance)
{
  this->Rays = &scene;
  this->Radius = radius;
  this->Tolerance = tolerance;
}

vtkPenumbraIrradianceSource::Estimate vtkPenumbraBruteForceSource::Occlusion(
  const double point[3], const double normal[3]) const
{
  const penumbra::Scene& scene = this->Rays->GetScene();
  const glm::vec3 position((glm::dvec3(point[0], point[1], point[2]) - scene.Origin) * scene.Scale);
  Hemisphere hemisphere(*this->Rays, position, glm::vec3(normal[0], normal[1], normal[2]),
    static_cast<float>(this->Radius * scene.Scale));

  // The error of a grid falls with its rays to the power 3/4 (only cells on the border of an
  // occluder contribute), so grids are averaged with weights of rays to the power 3/2.
  Estimate total;
  double weights = 0.0;
  double variance = 0.0;
  for (int side = FirstGrid;; side = side * 3 / 2)
  {
    const Estimate grid = hemisphere.Ask(side);
    const auto rays = static_cast<double>(grid.Rays);
    const double weight = std::pow(rays, 1.5);
    weights += weight;
    total.Value += (grid.Value - total.Value) * weight / weights;
    variance += weight * weight * grid.Error * grid.Error;
    total.Rays += grid.Rays;
    const double seen = std::sqrt(variance) / weights;
    const double hidden = HiddenShare / static_cast<double>(total.Rays);
    total.Error = std::sqrt(seen * seen + hidden * hidden);
    if (total.Error <= this->Tolerance || total.Rays >= this->MaximumRays)
    {
      return total;
    }
  }
}

void vtkPenumbraBruteForceSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaximumRays: " << this->MaximumRays << "\n";
}
