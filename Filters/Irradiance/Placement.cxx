// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Placement.h"

#include "CosineDirections.h"

#include <memory>

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

/// Nor further than this share of reach: what lies beyond reach was not seen.
constexpr float ShareOfReach = .25f;

/// A record that should reach less than this share of the least radius does not serve: its error
/// would be above twice the tolerance. It keeps others from being made in so many least radii.
constexpr double LeastShare = .7;
constexpr double IdleRadii = 2.0;

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
  const double least = this->Settings.LeastPixels * site.Pixel;
  const double radius =
    std::min(this->RadiusOf(record.Found), double(ShareOfReach) * this->Source.GetReach());
  record.Serves = radius >= LeastShare * least;
  record.Radius = static_cast<float>(record.Serves
      ? std::clamp(radius, least, std::max(least, this->Settings.MostPixels * site.Pixel))
      : IdleRadii * least);
  record.Lean = std::max(static_cast<float>(this->Settings.OffSurface) * record.Radius, site.Pixel);
  return record;
}

double Placement::RadiusOf(const Derived& found) const
{
  const double accuracy = std::min(1.0, SplitSphereAccuracy * std::sqrt(this->Settings.Tolerance));
  switch (this->Settings.Rule)
  {
    case RadiusRules::NearestHit:
      return accuracy * found.Nearest;
    case RadiusRules::HarmonicMean:
      return accuracy * found.HarmonicMean;
    default:
      return std::min(
        ReachOfOverlap * std::sqrt(2.0 * this->Settings.Tolerance / std::max(found.Bend, 1e-30f)),
        static_cast<double>(ShareOfRim * found.RimDistance));
  }
}

bool Placement::IsCovered(const RecordTree& tree, const Place& place)
{
  return tree.Cover(place) > LeastWeight;
}

bool Placement::AddLevel(const std::vector<Site>& sites, const ProgressCallback& progress)
{
  struct Outcome
  {
    std::unique_ptr<Record> Made;
    long long Rays = 0;
  };
  std::vector<Outcome> outcomes(sites.size());
  if (!InBatches(static_cast<int>(sites.size()), 0.0, 1.0, progress, [&](int i) {
        if (!IsCovered(this->Tree, sites[i]))
        {
          outcomes[i].Made = std::make_unique<Record>(this->Gather(sites[i], outcomes[i].Rays));
        }
      }))
  {
    return false;
  }
  for (std::size_t i = 0; i < sites.size(); ++i)
  {
    if (outcomes[i].Made)
    {
      const Record& made = *outcomes[i].Made;
      this->Tree.InsertClamped(
        made, static_cast<float>(this->Settings.LeastPixels) * sites[i].Pixel);
      this->Rays += outcomes[i].Rays;
      this->Idle += made.Serves ? 0 : 1;
    }
  }
  return true;
}

}
