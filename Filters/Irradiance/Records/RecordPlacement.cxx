// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RecordPlacement.h"

#include "Gathering/HemisphereRefinement.h"
#include "Gathering/IrradianceConstants.h"
#include "Shading/HemisphereSampling.h"

#include <algorithm>
#include <optional>

namespace penumbra
{
namespace
{

/// Returns the distance that the point may move until `emitterSample` becomes occluded or
/// unoccluded: until the nearest projected occluder edge reaches the direction of `emitterSample`.
double ShadowDistance(const std::vector<glm::vec3>& directions,
  const std::vector<HemisphereSample>& samples, const EmitterSample& emitterSample, int cell)
{
  const float reach = EmitterDistanceFraction * emitterSample.Distance;
  const float here = samples[cell].Distance;
  double minimum = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < directions.size(); ++i)
  {
    if ((samples[i].Distance >= reach) != (here >= reach))
    {
      const double edge = std::min(here, samples[i].Distance);
      const double angle = glm::distance(directions[i], emitterSample.Direction);
      minimum = std::min(minimum, angle / (1.0 / edge - 1.0 / emitterSample.Distance));
    }
  }
  return minimum;
}

/// Returns the minimum over all emitters whose contribution exceeds `tolerance`. Partially occluded
/// emitters are skipped, because the derivatives include their boundaries.
double ShadowDistance(const HemisphereGrid& grid, const glm::mat3& frame,
  const std::vector<glm::vec3>& directions, const std::vector<HemisphereSample>& samples,
  const std::vector<EmitterSample>& emitterSamples, double tolerance)
{
  double minimum = std::numeric_limits<double>::infinity();
  for (auto begin = emitterSamples.begin(); begin != emitterSamples.end();)
  {
    const auto end =
      std::find_if(begin, emitterSamples.end(), [&](const EmitterSample& emitterSample) {
        return emitterSample.EmitterIndex != begin->EmitterIndex;
      });
    double fraction = 0.0;
    bool seen = false;
    bool blocked = false;
    for (auto emitterSample = begin; emitterSample != end; ++emitterSample)
    {
      const glm::vec3 local = glm::transpose(frame) * emitterSample->Direction;
      const int cell = grid.FindCell(local);
      fraction += emitterSample->Contribution * std::max(local.z, 0.f);
      if (cell >= 0)
      {
        const bool here =
          samples[cell].Distance >= EmitterDistanceFraction * emitterSample->Distance;
        seen = seen || here;
        blocked = blocked || !here;
      }
    }
    for (auto emitterSample = begin;
         emitterSample != end && seen != blocked && fraction > tolerance; ++emitterSample)
    {
      const int cell = grid.FindCell(glm::transpose(frame) * emitterSample->Direction);
      minimum = cell < 0
        ? minimum
        : std::min(minimum, ShadowDistance(directions, samples, *emitterSample, cell));
    }
    begin = end;
  }
  return minimum;
}

/// Returns true if `cell` hits a planar surface and a neighboring cell lies beyond its horizon.
bool EndsAtHorizon(const HemisphereGrid& grid, const std::vector<glm::vec3>& directions,
  const std::vector<HemisphereSample>& samples, int cell)
{
  const glm::vec3 normal = samples[cell].Normal;
  const float here = glm::dot(normal, directions[cell]);
  const int i = cell % grid.Side;
  const int j = cell / grid.Side;
  const auto ends = [&](bool exists, int other) {
    return exists && samples[other].Distance > samples[cell].Distance &&
      samples[other].Radiance != samples[cell].Radiance &&
      here * glm::dot(normal, directions[other]) < 0.f;
  };
  return (ends(i > 0, cell - 1) || ends(i + 1 < grid.Side, cell + 1) ||
           ends(j > 0, cell - grid.Side) || ends(j + 1 < grid.Side, cell + grid.Side)) &&
    IsFlat(grid, samples, cell);
}

/// Returns true if `shadingPoint` lies in a concave edge, where rounding decides on which
/// side of the other surface it is.
bool IsInCorner(glm::vec3 shadingPoint, const std::vector<HemisphereSample>& samples)
{
  const float gap = RayOriginOffset(shadingPoint);
  const auto touchingCount = std::count_if(samples.begin(), samples.end(),
    [gap](const HemisphereSample& sample) { return sample.Distance < gap; });
  return 4 * static_cast<std::size_t>(touchingCount) > samples.size();
}

int RoundToValidSide(double side)
{
  const int steps = static_cast<int>(std::lround(side / HemisphereGrid::Step));
  return std::clamp(
    steps * HemisphereGrid::Step, HemisphereGrid::MinimumSide, HemisphereGrid::MaximumSide);
}

}

RecordPlacement::RecordPlacement(
  const Gatherer& gatherer, const RecordPlacementSettings& settings, RecordOctree& tree)
  : Source(gatherer),
    Settings(settings),
    Tree(tree)
{
  this->Settings.Side =
    settings.Side > 0 ? RoundToValidSide(settings.Side) : ComputeSide(settings.Tolerance);
}

float RecordPlacement::GetMinimumRadius(const RecordCandidate& site) const
{
  return static_cast<float>(this->Settings.MinimumRadiusPixels * site.Pixel);
}

int RecordPlacement::ComputeSide(double tolerance)
{
  return RoundToValidSide(ReferenceGridSide * std::pow(ReferenceGridError / tolerance, 2.0 / 3.0));
}

float RecordPlacement::ComputeNormalAngle(double tolerance)
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
  record.GeometricNormal = site.GeometricNormal;
  record.Patch = site.Patch;
  const glm::mat3 frame = FrameFromNormal(site.Normal);
  record.Tangent = frame[0];
  const std::uint32_t seed = HashPoint(site.Position, site.Normal);
  std::vector<glm::vec3> local;
  std::vector<glm::vec3> directions;
  std::vector<HemisphereSample> samples;
  std::vector<EmitterSample> emitterSamples;
  if (this->Settings.Refine)
  {
    this->Source.SampleEmitters(site.Position, emitterSamples);
  }
  const bool atOnce = this->Settings.Refine || this->Source.SamplesGridAtOnce();
  const int first = atOnce ? this->Settings.Side : CoarseSide;
  for (int side = first;; side = this->Settings.Side)
  {
    const HemisphereGrid& grid = HemisphereGrid::Get(side);
    rays +=
      this->Source.SampleHemisphere(site.Position, TangentFrame(frame, site.GetNormals().Geometric),
        grid, MixBits(seed + static_cast<std::uint32_t>(side)), local, samples);
    if (IsInCorner(site.Position, samples))
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
      SampledHemisphere hemisphere{ site.Position, site.GetNormals(), frame, grid, directions,
        samples };
      rays += RefineHemisphere(
        this->Source, hemisphere, emitterSamples, NoiseFraction * this->GetAbsoluteTolerance());
    }
    if (side >= this->Settings.Side)
    {
      rays += this->FindOccluderEdges(site, grid, directions, samples);
    }
    record.Gathered = EstimateHemisphere(grid, frame, local, samples, this->Source.GetFalloff());
    if (side >= this->Settings.Side || record.Gathered.Error == 0.f)
    {
      break;
    }
  }
  const double minimum = this->Settings.MinimumRadiusPixels * site.Pixel;
  // Equal samples have no derivatives: the model of the split sphere [IC] bounds the radius under
  // occluders whose edges the grid misses, such as a near parallel surface.
  const bool isUniform = record.Gathered.Error == 0.f;
  const double clear = ComputeObstacleRadius(site, record.Gathered);
  const double radius = std::min({ this->ComputeRadius(record.Gathered),
    isUniform ? this->ComputeAccuracy() * record.Gathered.HarmonicMean
              : std::numeric_limits<double>::infinity(),
    double(OcclusionRadiusFraction) * this->Source.GetRadius(),
    (isUniform ? UniformRadiusFraction : 1.0) * std::min<double>(site.MaximumRadius, clear) });
  record.IsValid = this->Settings.KeepAllValid ||
    radius >= (std::isinf(site.ObstacleDistance) ? MinimumRadiusFraction : 1.0) * minimum;
  const double shadow = ShadowRadiusFraction *
    ShadowDistance(HemisphereGrid::Get(this->Settings.Side), frame, directions, samples,
      emitterSamples, this->GetAbsoluteTolerance());
  record.Radius = static_cast<float>(record.IsValid
      ? std::clamp(std::min(radius, shadow), minimum,
          std::max(minimum, this->Settings.MaximumRadiusPixels * site.Pixel))
      : InvalidRadiusFactor * minimum);
  if (this->Settings.KeepAllValid && radius < record.Radius)
  {
    // Limit the change within the enlarged radius to that within the radius of the rule.
    for (glm::vec3& gradient : record.Gathered.Translation)
    {
      gradient *= static_cast<float>(radius) / record.Radius;
    }
  }
  for (float& clearance : record.Gathered.Clearance)
  {
    clearance *= this->Settings.ClearanceFraction;
  }
  // A larger distance would include parallel surfaces, such as the floors of shallow pockets.
  record.MaximumPlaneDistance = site.Pixel;
  return record;
}

long long RecordPlacement::FindOccluderEdges(const RecordCandidate& site,
  const HemisphereGrid& grid, const std::vector<glm::vec3>& directions,
  std::vector<HemisphereSample>& samples) const
{
  std::vector<int> cells;
  for (int cell = 0; cell < grid.Cells(); ++cell)
  {
    if (EndsAtHorizon(grid, directions, samples, cell))
    {
      cells.push_back(cell);
    }
  }
  long long rays = 0;
  std::vector<glm::vec3> refined;
  std::vector<HemisphereSample> hits;
  for (const float fraction : HorizonFractions)
  {
    refined.clear();
    for (const int cell : cells)
    {
      const glm::vec3 normal = samples[cell].Normal;
      const float here = glm::dot(normal, directions[cell]);
      refined.push_back(glm::normalize(directions[cell] - (1.f - fraction) * here * normal));
    }
    if (cells.empty())
    {
      break;
    }
    rays += this->Source.Gather(site.Position, site.GetNormals(), refined, hits);
    std::vector<int> left;
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      const bool continues = !std::isinf(hits[i].Distance) &&
        std::abs(glm::dot(hits[i].Normal, samples[cells[i]].Normal)) > .999f;
      samples[cells[i]].OccluderEdge = continues ? 2.f * hits[i].Distance : 0.f;
      if (!continues)
      {
        left.push_back(cells[i]);
      }
    }
    cells = std::move(left);
  }
  return rays;
}

double RecordPlacement::ComputeAccuracy() const
{
  return std::min(1.0, SplitSphereAccuracy * std::sqrt(this->Settings.Tolerance));
}

double RecordPlacement::ComputeObstacleRadius(
  const RecordCandidate& site, const HemisphereEstimate& estimate)
{
  const bool isSeen = estimate.Nearest <= SeenDistanceFactor * site.ObstacleDistance;
  return (isSeen ? SeenObstacleFraction : ObstacleRadiusFraction) * site.ObstacleDistance;
}

double RecordPlacement::ComputeRadius(const HemisphereEstimate& estimate) const
{
  const double accuracy = this->ComputeAccuracy();
  switch (this->Settings.Rule)
  {
    case RadiusRules::NearestHit:
      return accuracy * estimate.Nearest;
    case RadiusRules::HarmonicMean:
      return accuracy * estimate.HarmonicMean;
    default:
      return std::min(OverlapFactor *
          std::sqrt(2.0 * this->GetAbsoluteTolerance() / std::max(estimate.HessianNorm, 1e-30f)),
        static_cast<double>(OccluderEdgeFraction * estimate.OccluderEdgeDistance));
  }
}

bool RecordPlacement::IsCovered(const ShadingPoint& shadingPoint) const
{
  return this->Tree.MaximumWeightAt(shadingPoint) > this->Settings.CoverageWeight;
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
  if (!ParallelForWithProgress(static_cast<int>(sites.size()), 0.0, 1.0, progress, [&](int i) {
        if (!this->IsCovered(sites[i]))
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
      this->Tree.InsertClamped(
        made, static_cast<float>(this->Settings.MinimumRadiusPixels), this->Settings.ClampReached);
      this->InvalidRecords += made.IsValid ? 0 : 1;
    }
  }
  return true;
}

}
