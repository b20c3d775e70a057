// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RecordPlacement.h"

#include "Shading/HemisphereSampling.h"

#include <algorithm>
#include <optional>

namespace penumbra
{
namespace
{

/// A point is covered if the maximum weight of a record exceeds this. Some overlap makes transitions
/// smooth; more overlap costs records and gains less than the tolerance (benchmark `irradiance`).
constexpr float LeastWeight = .05f;

/// Factor on the radius at which the error of a single record, half its Hessian norm times the squared
/// distance, equals the tolerance. Larger than 1 because weights decrease toward the radius and errors
/// of neighboring records cancel. Measured with the benchmark `irradiance`.
constexpr double OverlapFactor = 2.0;

/// Error of the mean of a grid with side ReferenceSide if half of the hemisphere is occluded. It
/// decreases with the power -3/2 of the side. Measured with the benchmark `irradiance`.
constexpr double ReferenceSide = 32.0;
constexpr double ReferenceError = .005;

/// Side of the first grid. The full grid follows if the samples of the first differ. Occluders that the
/// first grid misses are too small or too far to matter within the maximum radius.
constexpr int FirstSide = 16;

/// Maximum radius as a fraction of the distance of occluder edges, near which the derivatives change.
constexpr float OccluderEdgeFraction = .5f;

/// Ratio of the accuracy of split-sphere radii (a fraction of the distance) to the square root of the
/// tolerance. Gives about the usual accuracy of 0.3 at a tolerance of 0.005.
constexpr double SplitSphereAccuracy = 4.0;

/// Maximum radius as a fraction of the limit of the candidate if all samples are equal. The grid misses
/// low distant occluders that nearer points see.
constexpr double ShareOfEmpty = .5;

/// Maximum radius as a fraction of the distance to the shadow boundary of an emitter.
constexpr double ShareOfShadow = .5;

/// Hits nearer than this fraction of the distance of an emitter occlude it.
constexpr float ShareOfLamp = .97f;

/// Maximum radius as a fraction of the maximum distance of occluders; rays end at that distance.
constexpr float ShareOfReach = .25f;

/// A record is invalid if its radius is below this fraction of the minimum radius: its error would be
/// above twice the tolerance.
constexpr double LeastShare = .7;

/// Radius of an invalid record over the minimum radius. No other record is placed within this radius.
constexpr double InvalidRadiusFactor = 2.0;

/// Accepted noise of one record as a fraction of the tolerance if cells are supersampled.
constexpr double NoiseShare = .5;

/// Maximum number of parts along each side of a supersampled cell.
constexpr int Finest = 12;

/// Maximum number of supersampling rays over the number of cells.
constexpr double MostRays = 3.0;

/// Estimates the variance of the single sample of a cell from its neighbors. The covered fraction of a
/// cell that a straight boundary cuts has the variance 1/6.
float VarianceOf(const HemisphereGrid& grid, const std::vector<HemisphereSample>& sights, int cell)
{
  const int i = cell % grid.Side;
  const int j = cell / grid.Side;
  float most = 0.f;
  for (const int other : { i > 0 ? cell - 1 : cell, i + 1 < grid.Side ? cell + 1 : cell,
         j > 0 ? cell - grid.Side : cell, j + 1 < grid.Side ? cell + grid.Side : cell })
  {
    const glm::vec3 step = glm::abs(sights[other].Radiance - sights[cell].Radiance);
    most = std::max({ most, step.x, step.y, step.z });
  }
  return most * most / 6.f;
}

/// Returns the cell that contains `direction` (local coordinates); -1 below the horizon.
int CellOf(const HemisphereGrid& grid, glm::vec3 direction)
{
  if (direction.z < 0.f)
  {
    return -1;
  }
  const glm::ivec2 at(
    InvertUniformDiskConcentric(glm::vec2(direction)) * static_cast<float>(grid.Side));
  const glm::ivec2 in = glm::clamp(at, glm::ivec2(0), glm::ivec2(grid.Side - 1));
  return in.y * grid.Side + in.x;
}

/// Raises the variance of the cells around `direction` (local coordinates), because an emitter of
/// `strength` may be visible there even if no ray hit it. Without this, the rays of small emitters would
/// depend on chance hits and such emitters would be too dark on average.
void RaiseVarianceNearEmitter(
  const HemisphereGrid& grid, glm::vec3 direction, float strength, std::vector<float>& variances)
{
  const int cell = CellOf(grid, direction);
  if (cell < 0)
  {
    return;
  }
  const glm::ivec2 middle(cell % grid.Side, cell / grid.Side);
  const glm::ivec2 low = glm::max(middle - 1, 0);
  const glm::ivec2 high = glm::min(middle + 1, grid.Side - 1);
  for (int j = low.y; j <= high.y; ++j)
  {
    for (int i = low.x; i <= high.x; ++i)
    {
      float& variance = variances[j * grid.Side + i];
      variance = std::max(variance, strength * strength / 6.f);
    }
  }
}

/// Returns the distance that the point may move until `beam` becomes occluded or unoccluded: until the
/// nearest projected occluder edge reaches the direction of `beam`.
double ShadowDistance(const std::vector<glm::vec3>& directions,
  const std::vector<HemisphereSample>& sights, const EmitterSample& beam, int cell)
{
  const float reach = ShareOfLamp * beam.Distance;
  const float here = sights[cell].Distance;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < directions.size(); ++i)
  {
    if ((sights[i].Distance >= reach) != (here >= reach))
    {
      const double edge = std::min(here, sights[i].Distance);
      const double angle = glm::distance(directions[i], beam.Direction);
      least = std::min(least, angle / (1.0 / edge - 1.0 / beam.Distance));
    }
  }
  return least;
}

/// Returns the minimum over all emitters whose contribution exceeds `tolerance`. Partially occluded
/// emitters are skipped, because the derivatives include their boundaries.
double ShadowDistance(const HemisphereGrid& grid, const glm::mat3& frame,
  const std::vector<glm::vec3>& directions, const std::vector<HemisphereSample>& sights,
  const std::vector<EmitterSample>& beams, double tolerance)
{
  double least = std::numeric_limits<double>::infinity();
  for (auto begin = beams.begin(); begin != beams.end();)
  {
    const auto end = std::find_if(begin, beams.end(),
      [&](const EmitterSample& beam) { return beam.EmitterIndex != begin->EmitterIndex; });
    double share = 0.0;
    bool seen = false;
    bool blocked = false;
    for (auto beam = begin; beam != end; ++beam)
    {
      const glm::vec3 local = glm::transpose(frame) * beam->Direction;
      const int cell = CellOf(grid, local);
      share += beam->Share * std::max(local.z, 0.f);
      if (cell >= 0)
      {
        const bool here = sights[cell].Distance >= ShareOfLamp * beam->Distance;
        seen = seen || here;
        blocked = blocked || !here;
      }
    }
    for (auto beam = begin; beam != end && seen != blocked && share > tolerance; ++beam)
    {
      const int cell = CellOf(grid, glm::transpose(frame) * beam->Direction);
      least = cell < 0 ? least : std::min(least, ShadowDistance(directions, sights, *beam, cell));
    }
    begin = end;
  }
  return least;
}

/// Returns the number of parts m along each side of each cell for which the sum of variances is at most
/// `allowed` at minimum cost. m * m rays in a cell that a boundary cuts reduce its variance to m^-3,
/// so that m^5 in proportion to the variance is optimal.
std::vector<int> AllocateSubsamples(const std::vector<float>& variances, double allowed)
{
  std::vector<int> finer(variances.size(), 1);
  const double most = MostRays * static_cast<double>(variances.size());
  double unit = *std::max_element(variances.begin(), variances.end());
  while (unit > 0.0)
  {
    double rays = 0.0;
    double sum = 0.0;
    std::vector<int> tried(variances.size());
    for (std::size_t i = 0; i < variances.size(); ++i)
    {
      const int m = static_cast<int>(std::pow(variances[i] / unit, .2) + .5);
      tried[i] = std::clamp(m, 1, Finest);
      rays += tried[i] > 1 ? tried[i] * tried[i] : 0;
      sum += variances[i] / std::pow(tried[i], 3.0);
    }
    if (rays > most)
    {
      break;
    }
    finer = std::move(tried);
    if (sum <= allowed)
    {
      break;
    }
    unit *= .25;
  }
  return finer;
}

/// Averages the next m * m samples of `closer` into `sight`.
void AverageSubsamples(
  int m, std::vector<HemisphereSample>::const_iterator& closer, HemisphereSample& sight)
{
  const auto share = 1.f / static_cast<float>(m * m);
  sight.Radiance = glm::vec3(0.f);
  for (int k = 0; k < m * m; ++k, ++closer)
  {
    sight.Radiance += share * closer->Radiance;
    if (closer->Distance < sight.Distance)
    {
      sight.Distance = closer->Distance;
      sight.Normal = closer->Normal;
    }
  }
  sight.Variance = 1.f / static_cast<float>(m * m * m);
}

/// Fractions of the angle between a ray and the horizon of the planar surface that it hit, at which
/// further rays test whether the surface continues.
constexpr float SharesOfHorizon[] = { .002f, .016f, .125f };

/// Returns true if `cell` hits a planar surface and a neighboring cell lies beyond its horizon.
bool EndsAtHorizon(const HemisphereGrid& grid, const std::vector<glm::vec3>& directions,
  const std::vector<HemisphereSample>& sights, int cell)
{
  const glm::vec3 normal = sights[cell].Normal;
  const float here = glm::dot(normal, directions[cell]);
  const int i = cell % grid.Side;
  const int j = cell / grid.Side;
  const auto ends = [&](bool exists, int other) {
    return exists && sights[other].Distance > sights[cell].Distance &&
      sights[other].Radiance != sights[cell].Radiance &&
      here * glm::dot(normal, directions[other]) < 0.f;
  };
  return (ends(i > 0, cell - 1) || ends(i + 1 < grid.Side, cell + 1) ||
           ends(j > 0, cell - grid.Side) || ends(j + 1 < grid.Side, cell + grid.Side)) &&
    IsFlat(grid, sights, cell);
}

/// Returns true if `place` lies on the line of a corner, where rounding decides on which side of the other
/// surface it is.
bool IsInCorner(glm::vec3 place, const std::vector<HemisphereSample>& sights)
{
  const float gap = RayOriginOffset(place);
  const auto touching = std::count_if(sights.begin(), sights.end(),
    [gap](const HemisphereSample& sight) { return sight.Distance < gap; });
  return 4 * static_cast<std::size_t>(touching) > sights.size();
}

int RoundSide(double side)
{
  const int steps = static_cast<int>(std::lround(side / HemisphereGrid::Step));
  return std::clamp(
    steps * HemisphereGrid::Step, HemisphereGrid::LeastSide, HemisphereGrid::MostSide);
}

}

RecordPlacement::RecordPlacement(
  const Gatherer& gatherer, const RecordPlacementSettings& settings, RecordOctree& tree)
  : Source(gatherer),
    Settings(settings),
    Tree(tree)
{
  this->Settings.Side = settings.Side > 0 ? RoundSide(settings.Side) : SideFor(settings.Tolerance);
}

int RecordPlacement::SideFor(double tolerance)
{
  return RoundSide(ReferenceSide * std::pow(ReferenceError / tolerance, 2.0 / 3.0));
}

float RecordPlacement::NormalAngleFor(double tolerance)
{
  // Rotation by an angle a causes an error of at most about a^2 / 2 of the mean.
  const double angle = OverlapFactor * std::sqrt(2.0 * tolerance);
  return static_cast<float>(std::clamp(angle, .05, .7));
}

std::optional<Record> RecordPlacement::Gather(const RecordCandidate& site, long long& rays) const
{
  Record record;
  record.Position = site.Position;
  record.Normal = site.Normal;
  const glm::mat3 frame = FrameFromNormal(site.Normal);
  record.Tangent = frame[0];
  const std::uint32_t seed = HashPoint(site.Position, site.Normal);
  std::vector<glm::vec3> local;
  std::vector<glm::vec3> directions;
  std::vector<HemisphereSample> sights;
  std::vector<EmitterSample> beams;
  if (this->Settings.Refine)
  {
    this->Source.SampleEmitters(site.Position, beams);
  }
  const bool atOnce = this->Settings.Refine || this->Source.SamplesGridAtOnce();
  const int first = atOnce ? this->Settings.Side : FirstSide;
  for (int side = first;; side = this->Settings.Side)
  {
    const HemisphereGrid& grid = HemisphereGrid::Get(side);
    rays += this->Source.SampleHemisphere(
      site.Position, frame, grid, MixBits(seed + static_cast<std::uint32_t>(side)), local, sights);
    if (IsInCorner(site.Position, sights))
    {
      return std::nullopt;
    }
    directions.clear();
    for (const glm::vec3& direction : local)
    {
      directions.push_back(frame * direction);
    }
    if (this->Settings.Refine && !this->Source.SamplesGridAtOnce())
    {
      rays += this->SupersampleCells(site, frame, grid, beams, sights);
    }
    if (side >= this->Settings.Side)
    {
      rays += this->FindOccluderEdges(site, grid, directions, sights);
    }
    record.Gathered = EstimateHemisphere(grid, frame, local, sights, this->Source.GetFalloff());
    if (side >= this->Settings.Side || record.Gathered.Error == 0.f)
    {
      break;
    }
  }
  const double least = this->Settings.MinimumRadiusPixels * site.Pixel;
  const double radius =
    std::min({ this->RadiusOf(record.Gathered), double(ShareOfReach) * this->Source.GetReach(),
      (record.Gathered.Error == 0.f ? ShareOfEmpty : 1.0) * site.MaximumRadius });
  record.IsValid = this->Settings.KeepAllValid || radius >= LeastShare * least;
  const double shadow = ShareOfShadow *
    ShadowDistance(HemisphereGrid::Get(this->Settings.Side), frame, directions, sights, beams,
      this->Settings.Tolerance);
  record.Radius =
    static_cast<float>(record.IsValid ? std::clamp(std::min(radius, shadow), least,
                                          std::max(least, this->Settings.MostPixels * site.Pixel))
                                      : InvalidRadiusFactor * least);
  if (this->Settings.KeepAllValid && radius < record.Radius)
  {
    // Limit the change within the enlarged radius to that within the radius of the rule.
    for (glm::vec3& gradient : record.Gathered.Translation)
    {
      gradient *= static_cast<float>(radius) / record.Radius;
    }
  }
  // A larger distance would include parallel surfaces, such as the floors of shallow pockets.
  record.MaximumPlaneDistance = site.Pixel;
  return record;
}

long long RecordPlacement::SupersampleCells(const RecordCandidate& site, const glm::mat3& frame,
  const HemisphereGrid& grid, const std::vector<EmitterSample>& beams,
  std::vector<HemisphereSample>& sights) const
{
  std::vector<float> variances(sights.size());
  for (int cell = 0; cell < grid.Cells(); ++cell)
  {
    variances[cell] = VarianceOf(grid, sights, cell);
  }
  for (const EmitterSample& beam : beams)
  {
    RaiseVarianceNearEmitter(
      grid, glm::transpose(frame) * beam.Direction, beam.Strength, variances);
  }
  const double allowed = std::pow(NoiseShare * this->Settings.Tolerance * grid.Cells(), 2.0);
  const std::vector<int> finer = AllocateSubsamples(variances, allowed);
  std::uint32_t random = HashPoint(site.Position, -site.Normal);
  std::vector<glm::vec3> directions;
  for (int cell = 0; cell < grid.Cells(); ++cell)
  {
    if (finer[cell] > 1)
    {
      grid.SubsampleCell(cell, finer[cell], random, directions);
    }
  }
  if (directions.empty())
  {
    return 0;
  }
  for (glm::vec3& direction : directions)
  {
    direction = frame * direction;
  }
  std::vector<HemisphereSample> closer;
  const long long rays = this->Source.Gather(site.Position, site.Normal, directions, closer);
  std::vector<HemisphereSample>::const_iterator next = closer.begin();
  for (int cell = 0; cell < grid.Cells(); ++cell)
  {
    if (finer[cell] > 1)
    {
      AverageSubsamples(finer[cell], next, sights[cell]);
    }
  }
  return rays;
}

long long RecordPlacement::FindOccluderEdges(const RecordCandidate& site,
  const HemisphereGrid& grid, const std::vector<glm::vec3>& directions,
  std::vector<HemisphereSample>& sights) const
{
  std::vector<int> cells;
  for (int cell = 0; cell < grid.Cells(); ++cell)
  {
    if (EndsAtHorizon(grid, directions, sights, cell))
    {
      cells.push_back(cell);
    }
  }
  long long rays = 0;
  std::vector<glm::vec3> closer;
  std::vector<HemisphereSample> found;
  for (const float share : SharesOfHorizon)
  {
    closer.clear();
    for (const int cell : cells)
    {
      const glm::vec3 normal = sights[cell].Normal;
      const float here = glm::dot(normal, directions[cell]);
      closer.push_back(glm::normalize(directions[cell] - (1.f - share) * here * normal));
    }
    if (cells.empty())
    {
      break;
    }
    rays += this->Source.Gather(site.Position, site.Normal, closer, found);
    std::vector<int> left;
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      const bool goesOn = !std::isinf(found[i].Distance) &&
        std::abs(glm::dot(found[i].Normal, sights[cells[i]].Normal)) > .999f;
      sights[cells[i]].OccluderEdge = goesOn ? 2.f * found[i].Distance : 0.f;
      if (!goesOn)
      {
        left.push_back(cells[i]);
      }
    }
    cells = std::move(left);
  }
  return rays;
}

double RecordPlacement::RadiusOf(const HemisphereEstimate& found) const
{
  const double accuracy = std::min(1.0, SplitSphereAccuracy * std::sqrt(this->Settings.Tolerance));
  switch (this->Settings.Rule)
  {
    case RadiusRules::NearestHit:
      return accuracy * found.Nearest;
    case RadiusRules::HarmonicMean:
      return accuracy * found.HarmonicMean;
    default:
      return std::min(OverlapFactor *
          std::sqrt(2.0 * this->Settings.Tolerance / std::max(found.HessianNorm, 1e-30f)),
        static_cast<double>(OccluderEdgeFraction * found.OccluderEdgeDistance));
  }
}

bool RecordPlacement::IsCovered(const RecordOctree& tree, const ShadingPoint& place)
{
  return tree.MaximumWeightAt(place) > LeastWeight;
}

bool RecordPlacement::AddLevel(
  const std::vector<RecordCandidate>& sites, const ProgressCallback& progress)
{
  constexpr std::size_t StoppableRecords = 1024;
  struct Outcome
  {
    std::optional<Record> Made;
    long long Rays = 0;
  };
  std::vector<Outcome> outcomes(sites.size());
  if (!ParallelForBatches(static_cast<int>(sites.size()), 0.0, 1.0, progress, [&](int i) {
        if (!IsCovered(this->Tree, sites[i]))
        {
          outcomes[i].Made = this->Gather(sites[i], outcomes[i].Rays);
        }
      }))
  {
    return false;
  }
  for (std::size_t i = 0; i < sites.size(); ++i)
  {
    if (i % StoppableRecords == 0 && progress && progress(1.0))
    {
      return false;
    }
    this->Rays += outcomes[i].Rays;
    if (outcomes[i].Made)
    {
      const Record& made = *outcomes[i].Made;
      this->Tree.InsertClamped(made, static_cast<float>(this->Settings.MinimumRadiusPixels));
      this->Idle += made.IsValid ? 0 : 1;
    }
  }
  return true;
}

}
