// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraBruteForceIrradiance.h"

#include "Embree/RayScene.h"
#include "SceneCoordinates.h"
#include "Shading/DistanceFalloff.h"
#include "Shading/HemisphereSampling.h"
#include "Shading/Illumination.h"
#include "Shading/OwenSobolSequence.h"
#include "Shading/RayTracingConstants.h"
#include "Shading/TranslucentOcclusion.h"

#include "vtkObjectFactory.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

vtkStandardNewMacro(vtkPenumbraBruteForceIrradiance);

vtkPenumbraBruteForceIrradiance::vtkPenumbraBruteForceIrradiance() = default;
vtkPenumbraBruteForceIrradiance::~vtkPenumbraBruteForceIrradiance() = default;

namespace
{

using penumbra::DistanceFalloff;
using penumbra::Ray;
using penumbra::RayScene;
using penumbra::SurfaceNormals;
using Estimate = vtkPenumbraIrradianceProvider::Estimate;

constexpr double Pi = glm::pi<double>();

/// Returns the smallest power of two that is at least 8 and `minimum`, but at most `limit` (or 8).
std::uint32_t ComputeFirstRound(std::uint32_t minimum, std::uint32_t limit)
{
  std::uint32_t count = 8;
  while (count < minimum && count <= limit / 2)
  {
    count *= 2;
  }
  return count;
}

SurfaceNormals ToSurfaceNormals(const double normal[3], const double geometricNormal[3])
{
  const glm::vec3 shading(normal[0], normal[1], normal[2]);
  return geometricNormal
    ? SurfaceNormals(shading, { geometricNormal[0], geometricNormal[1], geometricNormal[2] })
    : shading;
}

/// Occlusion estimate of the hemisphere above one point.
class Hemisphere
{
public:
  Hemisphere(const RayScene& rays, glm::vec3 point, const SurfaceNormals& normals,
    const DistanceFalloff& falloff, bool translucent, double tolerance)
    : Rays(rays),
      Falloff(falloff),
      Translucent(translucent),
      Cut(penumbra::ComputeOcclusionCut(tolerance)),
      Normals(normals),
      Frame(penumbra::FrameFromNormal(normals.Shading)),
      Directions(penumbra::HashPoint(point, normals.Shading))
  {
    this->RayTemplate.Origin = point + penumbra::RayOriginOffset(point) * normals.Geometric;
    this->RayTemplate.Far = falloff.Radius;
  }

  /// Traces rays until there are `count` of them, a power of two.
  Estimate TraceRays(std::uint32_t count)
  {
    if (this->Samples.size() < count)
    {
      this->TraceBlock(count);
    }
    const auto ends = std::minmax_element(this->Samples.begin(), this->Samples.end());
    const double range = *ends.second - *ends.first;
    const double squares = penumbra::OwenSobolSequence::SumPairDifferences(this->Samples) +
      penumbra::VarianceFloorPairs * range * range;
    const double pairError = penumbra::StratificationGain * std::sqrt(squares) / count;
    Estimate result;
    result.Rays = count + this->AdditionalRays;
    result.Value = this->Sum / count;
    result.Error = std::hypot(pairError, penumbra::UndetectedFraction / count);
    return result;
  }

private:
  static constexpr std::uint32_t PacketSize = 16;

  /// Traces the next rays, until there are `count` of them. Packets have rays of similar directions, which
  /// visit the same nodes.
  void TraceBlock(std::uint32_t count)
  {
    const auto first = static_cast<std::uint32_t>(this->Samples.size());
    std::vector<glm::vec2> points(count - first);
    for (std::uint32_t i = 0; i < points.size(); ++i)
    {
      points[i] = this->Directions.At(first + i);
    }
    const std::vector<std::uint32_t> order = SortByCell(points, PacketSize);
    this->Samples.resize(count);
    for (std::uint32_t begin = 0; begin < order.size(); begin += PacketSize)
    {
      const auto size = std::min<std::uint32_t>(order.size() - begin, PacketSize);
      Ray rays[PacketSize];
      float occlusion[PacketSize];
      for (std::uint32_t i = 0; i < PacketSize; ++i)
      {
        rays[i] = this->RayTemplate;
        rays[i].Far = i < size ? this->RayTemplate.Far : -1.f;
        const glm::vec2 at = points[order[begin + std::min(i, size - 1)]];
        rays[i].Direction = this->Normals.ReflectAbove(this->Frame *
          penumbra::DiskToHemisphere(penumbra::SampleUniformDiskConcentric(at.x, at.y)));
      }
      this->ComputeOcclusion(rays, occlusion);
      for (std::uint32_t i = 0; i < size; ++i)
      {
        this->Samples[first + order[begin + i]] = occlusion[i];
      }
    }
    this->Sum = std::accumulate(this->Samples.begin() + first, this->Samples.end(), this->Sum);
  }

  /// Returns the indices of points in the unit square, sorted by nearly square cells of which each has
  /// about `size` points.
  static std::vector<std::uint32_t> SortByCell(
    const std::vector<glm::vec2>& points, std::uint32_t size)
  {
    std::uint32_t columns = 1;
    std::uint32_t rows = 1;
    while (columns * rows * size < points.size())
    {
      (columns > rows ? rows : columns) *= 2;
    }
    std::vector<std::uint32_t> ends(columns * rows);
    std::vector<std::uint32_t> cells(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i)
    {
      cells[i] = static_cast<std::uint32_t>(points[i].y * static_cast<float>(rows)) * columns +
        static_cast<std::uint32_t>(points[i].x * static_cast<float>(columns));
      ++ends[cells[i]];
    }
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    std::vector<std::uint32_t> order(points.size());
    for (auto i = static_cast<std::uint32_t>(points.size()); i-- > 0;)
    {
      order[--ends[cells[i]]] = i;
    }
    return order;
  }

  /// Computes the occlusion of each ray of a packet. Without falloff, any hit suffices; otherwise
  /// the nearest hit is needed.
  void ComputeOcclusion(const Ray* rays, float* occlusion)
  {
    if (this->Falloff.IsConstant() && !this->Translucent)
    {
      bool occluded[PacketSize];
      this->Rays.Occluded16(rays, occluded);
      std::copy(occluded, occluded + PacketSize, occlusion);
      return;
    }
    penumbra::Hit hits[PacketSize];
    this->Rays.Intersect16(rays, hits);
    for (std::uint32_t i = 0; i < PacketSize; ++i)
    {
      const penumbra::Hit hit = penumbra::SkipLinesAndPoints(this->Rays, rays[i], hits[i]);
      occlusion[i] = this->Translucent ? penumbra::TraceTranslucentOcclusion(this->Rays, rays[i],
                                           hit, this->Falloff, this->Cut, this->AdditionalRays)
        : hit.IsHit()                  ? this->Falloff.Evaluate(hit.Distance)
                                       : 0.f;
    }
  }

  const RayScene& Rays;
  DistanceFalloff Falloff;
  bool Translucent;
  float Cut; ///< transmittance at which rays end
  long long AdditionalRays = 0;
  SurfaceNormals Normals;
  glm::mat3 Frame;
  penumbra::OwenSobolSequence Directions;
  Ray RayTemplate;
  std::vector<float> Samples;
  double Sum = 0.0;
};

Hemisphere MakeHemisphere(const RayScene& rays,
  const vtkPenumbraIrradianceProvider::Occluders& occluders, const double point[3],
  const double normal[3], const double geometricNormal[3], bool translucent, double tolerance)
{
  const penumbra::SceneCoordinates& coordinates = rays.GetCoordinates();
  return Hemisphere(rays, coordinates.FromWorld(point), ToSurfaceNormals(normal, geometricNormal),
    DistanceFalloff::InScene(occluders.Radius, occluders.Falloff, coordinates.Scale), translucent,
    tolerance);
}

/// Traces at most `maximum` rays. A ray that many layers continue costs as much as many rays, but its
/// occlusion is a mean over these layers and varies less: fewer rays are traced first.
Estimate TraceWithin(Hemisphere& hemisphere, double tolerance, std::uint32_t maximum)
{
  constexpr std::uint32_t First = 4;
  Estimate estimate = hemisphere.TraceRays(First);
  const double work = static_cast<double>(maximum) * First / static_cast<double>(estimate.Rays);
  for (std::uint32_t count = 2 * First; count <= maximum; count *= 2)
  {
    if (count > work && estimate.Error <= tolerance)
    {
      break;
    }
    estimate = hemisphere.TraceRays(count);
  }
  return estimate;
}

}

bool vtkPenumbraBruteForceIrradiance::Begin(
  const penumbra::RayScene& scene, const Occluders& occluders, double tolerance, const Progress&)
{
  this->Rays = &scene;
  this->Translucent = penumbra::HasTranslucentOccluders(scene.GetSurfaces());
  this->OccluderSettings = occluders;
  this->Tolerance = tolerance;
  return true;
}

vtkPenumbraIrradianceProvider::Estimate vtkPenumbraBruteForceIrradiance::Occlusion(
  const double point[3], const double normal[3], const double geometricNormal[3]) const
{
  return this->OcclusionWithin(point, normal, this->Tolerance, geometricNormal);
}

vtkPenumbraIrradianceProvider::Estimate vtkPenumbraBruteForceIrradiance::OcclusionWithin(
  const double point[3], const double normal[3], double tolerance,
  const double geometricNormal[3]) const
{
  Hemisphere hemisphere = MakeHemisphere(*this->Rays, this->OccluderSettings, point, normal,
    geometricNormal, this->Translucent, tolerance);
  const auto limit = static_cast<std::uint32_t>(this->MaximumRays);
  if (tolerance > this->Tolerance)
  {
    // The number of rays is fixed in advance: stopping early when few rays agree would cause bias.
    const std::uint32_t maximum = limit / 2;
    const double needed =
      std::min<double>(std::pow(penumbra::StandardErrorScale / tolerance, 4.0 / 3.0), maximum);
    std::uint32_t count = 4;
    while (count < needed)
    {
      count *= 2;
    }
    return this->Translucent ? TraceWithin(hemisphere, tolerance, count)
                             : hemisphere.TraceRays(count);
  }
  for (std::uint32_t count = ComputeFirstRound(this->MinimumRays, limit);; count *= 2)
  {
    const Estimate estimate = hemisphere.TraceRays(count);
    if (estimate.Error <= tolerance || count > limit / 2 || estimate.Rays > limit)
    {
      return estimate;
    }
  }
}

bool vtkPenumbraBruteForceIrradiance::BeginIrradiance(
  const penumbra::Illumination& light, double tolerance, const Progress&)
{
  this->IrradianceTolerance = tolerance;
  this->Translucent = penumbra::HasTranslucentOccluders(light.GetRays().GetSurfaces());
  this->Lighting = std::make_unique<penumbra::Illumination>(light);
  this->Lighting->AcceptNoise(tolerance / Pi, penumbra::PathsPerRay * this->MinimumRays);
  return true;
}

vtkPenumbraIrradianceProvider::Light vtkPenumbraBruteForceIrradiance::Irradiance(
  const double point[3], const double normal[3], double tolerance,
  const double geometricNormal[3]) const
{
  const penumbra::Illumination& lighting = *this->Lighting;
  const glm::vec3 position(lighting.GetRays().GetCoordinates().FromWorld(point));
  const SurfaceNormals normals = ToSurfaceNormals(normal, geometricNormal);
  const glm::vec3 up = normals.Shading;
  const glm::mat3 frame = penumbra::FrameFromNormal(up);
  const std::uint32_t seed = penumbra::HashPoint(position, up);
  const int bounces = lighting.GetSettings().Bounces;
  std::uint32_t random = penumbra::MixBits(seed);
  Light result;
  const penumbra::Illumination::IrradianceFunction irradiance =
    [&](glm::vec3 next, const SurfaceNormals& nextNormal) {
      return lighting.TracePath(next, nextNormal, bounces - 1, random, result.Rays);
    };
  const auto trace = [&](glm::vec2 at) {
    const Ray ray = penumbra::Illumination::SpawnRay(position, normals,
      frame * penumbra::DiskToHemisphere(penumbra::SampleUniformDiskConcentric(at.x, at.y)));
    ++result.Rays;
    return lighting.IncidentRadiance(ray, lighting.GetRays().Intersect(ray), up,
      bounces > 1 ? irradiance : penumbra::Illumination::IrradianceFunction(), result.Rays);
  };
  const auto limit = static_cast<std::uint32_t>(this->MaximumRays);
  // One of many translucent layers needs fewer paths.
  const double fraction = this->Translucent && tolerance > this->IrradianceTolerance
    ? std::pow(this->IrradianceTolerance / tolerance, 4.0 / 3.0)
    : 1.0;
  const auto first =
    static_cast<std::uint32_t>(fraction * (penumbra::PathsPerRay * this->MinimumRays));
  const auto gathered = penumbra::EstimateStratifiedMean(
    trace, seed, ComputeFirstRound(first, limit), limit, tolerance / Pi);
  const auto sampled =
    lighting.EstimateSampledLight(position, normals, tolerance / Pi, result.Rays);
  result.Error = Pi * std::hypot(gathered.Error, sampled.Error);
  for (int c = 0; c < 3; ++c)
  {
    result.Value[c] = Pi * (gathered.Mean[c] + sampled.Mean[c]);
  }
  return result;
}

void vtkPenumbraBruteForceIrradiance::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "JoinPixels: " << this->JoinPixels << "\n";
  os << indent << "MinimumRays: " << this->MinimumRays << "\n";
  os << indent << "MaximumRays: " << this->MaximumRays << "\n";
}
