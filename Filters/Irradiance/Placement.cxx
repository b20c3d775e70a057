// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Placement.h"

#include "CosineDirections.h"

#include "vtkSMPTools.h"

namespace penumbra
{
namespace
{

/// Where the best record weighs less, another is made: overlaps are smooth. Measured by the
/// benchmark `irradiance` (more overlap costs records and gains less than the tolerance).
constexpr float LeastWeight = .05f;

/// A record errs by half its bend times the square of the distance; weights that fall towards its
/// rim, and neighbours that err the other way, let it reach this times further than its own
/// error there allows. Measured by the benchmark `irradiance`.
constexpr double ReachOfOverlap = 2.0;

/// A grid of this side errs by about this much where half of the hemisphere is blocked, and by the
/// power -3/2 of the side. Measured by the benchmark `irradiance`.
constexpr double KnownSide = 32.0;
constexpr double KnownError = .005;

/// Side of the first look. A finer one follows where anything was seen to change; what hides from
/// this one is too small or too far to matter within a record's greatest radius.
constexpr int FirstSide = 16;

/// No record serves nearer to a rim than this share of its distance: derivatives change there.
constexpr float ShareOfRim = .5f;

/// Between the accuracy of the split-sphere radii (a share of the distance) and the tolerance:
/// about the .3 that is usual at a tolerance of .005.
constexpr double SplitSphereAccuracy = 4.0;

int RoundSide(double side)
{
  const int steps = static_cast<int>(std::lround(side / HemisphereGrid::Step));
  return std::clamp(
    steps * HemisphereGrid::Step, HemisphereGrid::LeastSide, HemisphereGrid::MostSide);
}

}

Placement::Placement(const Gatherer& gatherer, const PlacementSettings& settings, RecordTree& tree)
  : Source(gatherer),
    Settings(settings),
    Tree(tree)
{
  this->Settings.Side = settings.Side > 0 ? RoundSide(settings.Side) : SideFor(settings.Tolerance);
}

int Placement::SideFor(double tolerance)
{
  return RoundSide(KnownSide * std::pow(KnownError / tolerance, 2.0 / 3.0));
}

float Placement::NormalAngleFor(double tolerance)
{
  // Turning by an angle a leaves out at most about a^2 / 2 of the mean.
  const double angle = ReachOfOverlap * std::sqrt(2.0 * tolerance);
  return static_cast<float>(std::clamp(angle, .05, .7));
}

bool Placement::IsServed(const Place& place) const
{
  return this->Tree.LookUp(place).Greatest > LeastWeight;
}

Record Placement::Gather(const Site& site, long long& rays) const
{
  Record record;
  record.Position = site.Position;
  record.Normal = site.Normal;
  const glm::mat3 frame = FrameOf(site.Normal);
  record.Tangent = frame[0];
  const std::uint32_t seed = SeedOf(site.Position, site.Normal);
  std::vector<glm::vec3> local;
  std::vector<glm::vec3> directions;
  std::vector<Sight> sights;
  for (int side = FirstSide;; side = this->Settings.Side)
  {
    const HemisphereGrid& grid = HemisphereGrid::Of(side);
    grid.Scatter(Mix(seed + static_cast<std::uint32_t>(side)), local);
    directions.clear();
    for (const glm::vec3& direction : local)
    {
      directions.push_back(frame * direction);
    }
    this->Source.Gather(site.Position, site.Normal, directions, sights);
    rays += grid.Cells();
    record.Found = Derive(grid, frame, local, sights, this->Source.GetReach());
    if (side >= this->Settings.Side || record.Found.Error == 0.f)
    {
      break;
    }
  }
  record.Radius = this->RadiusOf(record.Found, site);
  return record;
}

float Placement::RadiusOf(const Derived& found, const Site& site) const
{
  const double least = this->Settings.LeastPixels * site.Pixel;
  const double most = this->Settings.MostPixels * site.Pixel;
  const double accuracy = std::min(1.0, SplitSphereAccuracy * std::sqrt(this->Settings.Tolerance));
  double radius = most;
  switch (this->Settings.Rule)
  {
    case RadiusRules::NearestHit:
      radius = accuracy * found.Nearest;
      break;
    case RadiusRules::HarmonicMean:
      radius = accuracy * found.HarmonicMean;
      break;
    case RadiusRules::Hessian:
      radius = found.Bend > 0.f
        ? std::min(ReachOfOverlap * std::sqrt(2.0 * this->Settings.Tolerance / found.Bend),
            static_cast<double>(ShareOfRim * found.RimDistance))
        : most;
      break;
  }
  return static_cast<float>(std::clamp(radius, least, most));
}

std::size_t Placement::AddLevel(const std::vector<Site>& sites)
{
  struct Outcome
  {
    bool Added = false;
    long long Rays = 0;
    Record Made;
  };
  std::vector<Outcome> outcomes(sites.size());
  vtkSMPTools::For(0, static_cast<vtkIdType>(sites.size()), [&](vtkIdType begin, vtkIdType end) {
    for (vtkIdType i = begin; i < end; ++i)
    {
      if (!this->IsServed(sites[i]))
      {
        outcomes[i].Made = this->Gather(sites[i], outcomes[i].Rays);
        outcomes[i].Added = true;
      }
    }
  });
  std::size_t added = 0;
  for (std::size_t i = 0; i < sites.size(); ++i)
  {
    if (outcomes[i].Added)
    {
      this->Tree.InsertClamped(
        outcomes[i].Made, static_cast<float>(this->Settings.LeastPixels) * sites[i].Pixel);
      this->Rays += outcomes[i].Rays;
      ++added;
    }
  }
  return added;
}

}
