// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraBruteForceIrradiance.h"

#include "Embree/RayScene.h"
#include "Shading/DistanceFalloff.h"
#include "Shading/HemisphereSampling.h"
#include "Shading/Illumination.h"
#include "Shading/OwenSobolSequence.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <vector>

vtkStandardNewMacro(vtkPenumbraBruteForceIrradiance);

vtkPenumbraBruteForceIrradiance::vtkPenumbraBruteForceIrradiance() = default;
vtkPenumbraBruteForceIrradiance::~vtkPenumbraBruteForceIrradiance() = default;

namespace
{

using penumbra::DistanceFalloff;
using penumbra::Ray;
using penumbra::RayScene;
using Estimate = vtkPenumbraIrradianceProvider::Estimate;

constexpr double Pi = 3.14159265358979323846;

/// Even where all of n rays agree something may hide between them: its share is taken to be this
/// over n.
constexpr double HiddenShare = 0.5;

/// The error of the mean of n rays above half-planes and discs, over n^(-3/4), and over the error that
/// independent pairs of rays would have (both measured over thousands of random ones; the test
/// ReportsAnErrorThatIsTrue holds them to it).
constexpr double MeanError = 0.42;
constexpr double ShareOfPairs = 0.62;

/// Pairs on a border that are counted as differing whatever their rays say: some cells that a border
/// crosses agree by chance, and stopping on such luck would make the reported error too small.
constexpr double VarianceFloorPairs = 2.0;

/// Paths of the first round, over MinimumRays: lights are smaller than occluders.
constexpr std::uint32_t PathsPerRay = 8;

/// A power of two, `wanted` or more as far as `limit` allows.
std::uint32_t FirstRound(std::uint32_t wanted, std::uint32_t limit)
{
  std::uint32_t count = 8;
  while (count < wanted && count <= limit / 2)
  {
    count *= 2;
  }
  return count;
}

/// Rays above one point.
class Hemisphere
{
public:
  Hemisphere(
    const RayScene& rays, glm::vec3 point, glm::vec3 normal, const DistanceFalloff& falloff)
    : Rays(rays),
      Falloff(falloff),
      Frame(penumbra::FrameFromNormal(normal)),
      Directions(penumbra::HashPoint(point, normal))
  {
    this->Probe.Origin = point + penumbra::RayOriginOffset(point) * normal;
    this->Probe.Far = falloff.Radius;
  }

  /// Asks rays until there are `count` of them, a power of two.
  Estimate TraceRays(std::uint32_t count)
  {
    while (this->Answers.size() < count)
    {
      this->TracePacket(count);
    }
    const auto ends = std::minmax_element(this->Answers.begin(), this->Answers.end());
    const double step = *ends.second - *ends.first;
    const double seen =
      ShareOfPairs * std::sqrt(this->PairVariance() + VarianceFloorPairs * step * step) / count;
    Estimate result;
    result.Rays = count;
    result.Value = this->Blocked / count;
    result.Error = std::hypot(seen, HiddenShare / count);
    return result;
  }

private:
  static constexpr std::uint32_t PacketSize = 16;

  /// Asks the next rays, up to `count` in all.
  void TracePacket(std::uint32_t count)
  {
    const auto first = static_cast<std::uint32_t>(this->Answers.size());
    const std::uint32_t size = std::min(count - first, PacketSize);
    Ray rays[PacketSize];
    float blocked[PacketSize];
    for (std::uint32_t i = 0; i < PacketSize; ++i)
    {
      rays[i] = this->Probe;
      rays[i].Far = i < size ? this->Probe.Far : -1.f;
      const glm::vec2 at = this->Directions.At(first + i);
      rays[i].Direction =
        this->Frame * penumbra::DiskToHemisphere(penumbra::SampleUniformDiskConcentric(at.x, at.y));
    }
    this->ComputeBlocking(rays, blocked);
    for (std::uint32_t i = 0; i < size; ++i)
    {
      this->Answers.push_back(blocked[i]);
      this->Blocked += blocked[i];
    }
  }

  /// How much each ray is blocked. The nearest hit matters only where it does not count in full.
  void ComputeBlocking(const Ray* rays, float* blocked) const
  {
    if (this->Falloff.IsConstant())
    {
      bool met[PacketSize];
      this->Rays.Occluded16(rays, met);
      std::copy(met, met + PacketSize, blocked);
      return;
    }
    penumbra::Hit hits[PacketSize];
    this->Rays.Intersect16(rays, hits);
    for (std::uint32_t i = 0; i < PacketSize; ++i)
    {
      const penumbra::Hit hit = penumbra::SkipLinesAndPoints(this->Rays, rays[i], hits[i]);
      blocked[i] = hit.IsHit() ? this->Falloff.Evaluate(hit.Distance) : 0.f;
    }
  }

  /// Squares of the differences of the pairs of rays that share a cell, each cell holding two. Cells are
  /// boxes of the unit square as near to squares as can be.
  double PairVariance() const
  {
    const auto count = static_cast<std::uint32_t>(this->Answers.size());
    const std::uint32_t other = penumbra::OwenSobolSequence::FindPartner(count);
    double differences = 0.0;
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const double difference = this->Answers[i] - this->Answers[i ^ other];
      differences += difference * difference;
    }
    return .5 * differences;
  }

  const RayScene& Rays;
  DistanceFalloff Falloff;
  glm::mat3 Frame;
  penumbra::OwenSobolSequence Directions;
  Ray Probe;
  std::vector<float> Answers;
  double Blocked = 0.0;
};

Hemisphere MakeHemisphere(const RayScene& rays,
  const vtkPenumbraIrradianceProvider::Occluders& occluders, const double point[3],
  const double normal[3])
{
  const penumbra::Scene& scene = rays.GetScene();
  const glm::vec3 position((glm::dvec3(point[0], point[1], point[2]) - scene.Origin) * scene.Scale);
  return Hemisphere(rays, position, glm::vec3(normal[0], normal[1], normal[2]),
    DistanceFalloff::InScene(occluders.Radius, occluders.Falloff, scene.Scale));
}

}

bool vtkPenumbraBruteForceIrradiance::Begin(
  const penumbra::RayScene& scene, const Occluders& occluders, double tolerance, const Progress&)
{
  this->Rays = &scene;
  this->Counting = occluders;
  this->Tolerance = tolerance;
  return true;
}

vtkPenumbraIrradianceProvider::Estimate vtkPenumbraBruteForceIrradiance::Occlusion(
  const double point[3], const double normal[3]) const
{
  return this->OcclusionWithin(point, normal, this->Tolerance);
}

vtkPenumbraIrradianceProvider::Estimate vtkPenumbraBruteForceIrradiance::OcclusionWithin(
  const double point[3], const double normal[3], double tolerance) const
{
  Hemisphere hemisphere = MakeHemisphere(*this->Rays, this->Counting, point, normal);
  const auto limit = static_cast<std::uint32_t>(this->MaximumRays);
  if (tolerance > this->Tolerance)
  {
    // Few rays, their number chosen beforehand: to stop where few agree would be a bias.
    const std::uint32_t most = limit / 2;
    const double needed = std::min<double>(std::pow(MeanError / tolerance, 4.0 / 3.0), most);
    std::uint32_t count = 4;
    while (count < needed)
    {
      count *= 2;
    }
    return hemisphere.TraceRays(count);
  }
  for (std::uint32_t count = FirstRound(this->MinimumRays, limit);; count *= 2)
  {
    const Estimate answer = hemisphere.TraceRays(count);
    if (answer.Error <= tolerance || count > limit / 2)
    {
      return answer;
    }
  }
}

bool vtkPenumbraBruteForceIrradiance::BeginIrradiance(
  const penumbra::Illumination& light, double, const Progress&)
{
  this->Lighting = std::make_unique<penumbra::Illumination>(light);
  return true;
}

vtkPenumbraIrradianceProvider::Light vtkPenumbraBruteForceIrradiance::Irradiance(
  const double point[3], const double normal[3], double tolerance) const
{
  const penumbra::Illumination& lighting = *this->Lighting;
  const glm::vec3 position(lighting.GetRays().GetScene().FromWorld(point));
  const glm::vec3 up(normal[0], normal[1], normal[2]);
  const glm::mat3 frame = penumbra::FrameFromNormal(up);
  const std::uint32_t seed = penumbra::HashPoint(position, up);
  const penumbra::OwenSobolSequence directions(seed);
  const int bounces = lighting.GetSettings().Bounces;
  std::uint32_t random = penumbra::MixBits(seed);
  Light result;
  const penumbra::Illumination::IrradianceFunction arriving = [&](glm::vec3 at, glm::vec3 about) {
    return lighting.TracePath(at, about, bounces - 1, random, result.Rays);
  };

  glm::dvec3 sum(0.0);
  std::vector<float> greys;
  const auto limit = static_cast<std::uint32_t>(this->MaximumRays);
  for (std::uint32_t count = FirstRound(PathsPerRay * this->MinimumRays, limit);; count *= 2)
  {
    while (greys.size() < count)
    {
      const glm::vec2 at = directions.At(static_cast<std::uint32_t>(greys.size()));
      const Ray ray = penumbra::Illumination::SpawnRay(position, up,
        frame * penumbra::DiskToHemisphere(penumbra::SampleUniformDiskConcentric(at.x, at.y)));
      const glm::vec3 light = lighting.IncidentRadiance(ray, lighting.GetRays().Intersect(ray),
        bounces > 1 ? arriving : penumbra::Illumination::IrradianceFunction(), result.Rays);
      ++result.Rays;
      sum += light;
      greys.push_back((light.x + light.y + light.z) / 3.f);
    }
    const std::uint32_t partner = penumbra::OwenSobolSequence::FindPartner(count);
    double differences = 0.0;
    for (std::uint32_t i = 0; i < count; ++i)
    {
      differences += .5 * std::pow(greys[i] - greys[i ^ partner], 2.0);
    }
    result.Error = Pi * std::sqrt(differences) / count;
    if (result.Error <= tolerance || count > limit / 2)
    {
      break;
    }
  }
  const auto suns = lighting.EstimateSunlight(position, up, tolerance / Pi, result.Rays);
  result.Error = std::hypot(result.Error, Pi * suns.Error);
  for (int c = 0; c < 3; ++c)
  {
    result.Value[c] = Pi * (sum[c] / static_cast<double>(greys.size()) + suns.Mean[c]);
  }
  return result;
}

void vtkPenumbraBruteForceIrradiance::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MinimumRays: " << this->MinimumRays << "\n";
  os << indent << "MaximumRays: " << this->MaximumRays << "\n";
}
