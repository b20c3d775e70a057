// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Illumination.h"

#include "HemisphereSampling.h"
#include "Lights/EmissiveSurfaces.h"
#include "OwenSobolSequence.h"
#include "RayTracingConstants.h"
#include "Scene.h"
#include "Surface.h"
#include "Vectors.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace penumbra
{
namespace
{

constexpr float Pi = glm::pi<float>();

/// Lower bound of the cosine between a ray and the normal: rounding may make it 0.
constexpr float MinimumCosine = 1e-6f;

/// Under suns, the last ray of a path is traced with a probability of this gain times the ratio of the radiance that it
/// may meet and that of the samples of suns and emitters at its start, and at least with the smallest one.
constexpr float LastRayGain = 2.f;
constexpr float SmallestLastRayProbability = 0.125f;
/// Noise that this adds to a mean of paths where no sun is seen, as a fraction of the tolerance.
constexpr double LastRayNoise = 0.5;

/// Number of rays that are traced together.
constexpr std::size_t PacketSize = 16;

Ray MakeInactiveRay()
{
  Ray ray;
  ray.Far = -1.f;
  return ray;
}

bool IsActive(const Ray& ray)
{
  return ray.Near <= ray.Far;
}

/// Moves a point of the unit square in an outer cell of its row, of a grid of 4 x 4 cells, to the end of the row, and
/// in a corner of the grid to this corner. Rows are those of the map, sampled by the first coordinate.
glm::vec2 MoveToOutline(glm::vec2 point)
{
  constexpr float Inside = 0.999f;
  const glm::vec2 centered = 2.f * point - 1.f;
  const glm::vec2 ends = 0.5f + 0.5f * Inside * glm::sign(centered);
  const bool isOuter = std::abs(centered.y) > 0.5f;
  const bool isCorner = isOuter && std::abs(centered.x) > 0.5f;
  return { isCorner ? ends.x : point.x, isOuter ? ends.y : point.y };
}

template <std::size_t Size>
void SetSamples(
  std::array<LightReceiver, Size>& receivers, const glm::vec2* at, std::uint32_t count)
{
  for (std::uint32_t i = 0; i < count; ++i)
  {
    receivers[i].Sample = at[i];
  }
}

/// Returns the weight of a sample of density `own` if the same direction could have been sampled
/// with density `other`.
float PowerHeuristic(float own, float other)
{
  const float ratio = other / own;
  return 1.f / (1.f + ratio * ratio);
}

/// Returns the contribution of a sample of the suns without shadows, 0 if the surface does not face it, and sets the
/// ray toward it.
glm::vec3 UnshadowedSun(const EnvironmentMap& map, const LightReceiver& receiver, Ray& ray)
{
  const SurfaceNormals& normals = receiver.Normals;
  const EnvironmentMap::Sun sun = map.SampleSun(receiver.Sample);
  const float cosine = glm::dot(normals.Shading, sun.Direction);
  if (cosine > 0.f && glm::dot(normals.Geometric, sun.Direction) > 0.f)
  {
    ray = Illumination::SpawnRay(receiver.Position, normals, sun.Direction);
    return cosine / Pi * sun.Weight;
  }
  ray = MakeInactiveRay();
  return glm::vec3(0.f);
}

}

Illumination::Illumination(const RayScene& rays, const IlluminationSettings& settings)
  : Rays(rays),
    SurfaceShading(rays, settings.Shadows),
    Settings(settings)
{
  this->FindEmitters();
}

void Illumination::FindEmitters()
{
  EmissiveSurfaces found =
    FindEmissiveSurfaces(this->Rays.GetScene(), EmitterThreshold, MaximumEmitters);
  this->FindSourceRadiance(found.MeanRadiance);
  if (!found.Bright.empty())
  {
    this->SampledEmitters = std::make_shared<const EmitterTree>(std::move(found.Bright));
  }
  const bool round = found.HasTubes ||
    std::any_of(found.Dim.begin(), found.Dim.end(),
      [](const Emitter& emitter) { return emitter.Radius > 0.f; });
  if (!round && !found.HasMoreDim)
  {
    this->Emitters = std::move(found.Dim);
  }
}

void Illumination::FindSourceRadiance(double emitted)
{
  const EnvironmentMap* map = this->Settings.Map.get();
  const double color = MaximumComponent(glm::vec3(this->Settings.Environment));
  const double mean = std::max(emitted, map ? map->GetMeanRadiance() : color);
  double largest = EmitterThreshold * emitted;
  for (const Light& light : this->Rays.GetScene().Lights)
  {
    largest = std::max(largest, double(MaximumComponent(light.DiffuseColor)));
  }
  if (map && map->HasSuns())
  {
    const double sky = map->GetMeanRadiance() - map->GetSunIrradiance() / (4.0 * Pi);
    this->LastRadiance = static_cast<float>(std::max(largest, sky));
  }
  if (map && this->Settings.Bounces > 1)
  {
    largest = std::max(largest, this->Settings.Albedo * map->GetSunIrradiance() / Pi);
  }
  largest = std::max(largest, map ? map->GetLargestRadiance() : color);
  const auto orOne = [](double value) { return value > 0.0 && std::isfinite(value) ? value : 1.0; };
  this->Sources = { orOne(mean), orOne(largest) };
}

void Illumination::AcceptNoise(double tolerance, double paths)
{
  const double last =
    this->LastRadiance * std::pow(this->Settings.Albedo, this->Settings.Bounces - 1.0);
  const double ratio = LastRayNoise * tolerance * std::sqrt(paths) / std::max(last, 1e-30);
  this->UnlitProbability =
    std::max(static_cast<float>(1.0 / (1.0 + ratio * ratio)), SmallestLastRayProbability);
}

Ray Illumination::SpawnRay(glm::vec3 point, const SurfaceNormals& normals, glm::vec3 direction)
{
  Ray ray;
  ray.Origin = point + RayOriginOffset(point) * normals.Geometric;
  ray.Direction = normals.ReflectAbove(direction);
  return ray;
}

glm::vec3 Illumination::IncidentRadiance(
  Ray ray, Hit hit, glm::vec3 normal, const IrradianceFunction& irradiance, long long& rays) const
{
  glm::vec3 sum(0.f);
  float transmittance = 1.f;
  std::uint32_t seed = HashPoint(ray.Origin, ray.Direction);
  const float chosen = NextFloat(seed); // in [0, 1): where the ray ends for reflected light
  for (int layer = 0; layer < MaximumLayers; ++layer)
  {
    if (!hit.IsHit())
    {
      const EnvironmentMap* map = this->Settings.Map.get();
      return sum +
        transmittance * (map ? map->ClampedRadiance(ray.Direction) : this->Settings.Environment);
    }
    if (!this->Rays.GetScene().Surfaces[hit.Surface].IsLineOrPoint)
    {
      const ShadedHit shaded = this->SurfaceShading.ShadeDiffuse(ray, hit, rays);
      glm::vec3 radiance(shaded.Color);
      const float emitterDensity = this->HasSampledEmitters()
        ? this->SampledEmitters->ComputeDensity(
            ray.Origin, normal, ray.Direction, hit.Distance, hit.Surface, hit.Primitive)
        : 0.f;
      if (emitterDensity > 0.f)
      {
        const float density = std::max(glm::dot(normal, ray.Direction), MinimumCosine) / Pi;
        radiance -= (1.f - PowerHeuristic(density, emitterDensity)) * shaded.Emission;
      }
      const glm::vec3 reflectance = this->Settings.Albedo * shaded.Reflectance;
      const float opacity = std::min(shaded.Color.a, 1.f);
      const float weight = transmittance * opacity;
      // One layer is chosen by its weight: a path would branch at every layer otherwise.
      if (irradiance && reflectance != glm::vec3(0.f) && chosen >= 1.f - transmittance &&
        chosen < 1.f - transmittance + weight)
      {
        const glm::vec3 geometric = glm::normalize(shaded.GeometricNormal);
        radiance += reflectance / weight *
          irradiance(ray.Origin + hit.Distance * ray.Direction,
            { this->Rays.GetSmoothNormal(hit, geometric), geometric });
      }
      sum += weight * radiance;
      transmittance *= 1.f - opacity;
      if (transmittance < MinimumTransmittance)
      {
        return sum;
      }
    }
    ray = ContinueBehind(ray, hit);
    hit = this->Rays.Intersect(ray);
    ++rays;
  }
  return sum;
}

void Illumination::SunContributions(const LightReceiver* receivers, std::uint32_t count,
  glm::vec3* contributions, long long& rays) const
{
  std::array<Ray, PacketSize> packet;
  packet.fill(MakeInactiveRay());
  for (std::uint32_t i = 0; i < count; ++i)
  {
    contributions[i] = UnshadowedSun(*this->Settings.Map, receivers[i], packet[i]);
  }
  std::array<float, PacketSize> transmittances{};
  if (count == 1)
  {
    transmittances[0] =
      IsActive(packet[0]) ? this->SurfaceShading.TraceTransmittance(packet[0], rays) : 0.f;
  }
  else
  {
    this->SurfaceShading.TraceTransmittance16(packet.data(), transmittances.data(), rays);
  }
  for (std::uint32_t i = 0; i < count; ++i)
  {
    contributions[i] *= transmittances[i];
  }
}

// Of the first rays, those in outer cells are moved to the outline of the sun: edges of shadows hide or show a part of
// it first. If all rays agree, the sun is hidden or visible; otherwise further rays are traced even if the first ones
// of the sequence agree.
Illumination::SampledLight Illumination::EstimateSuns(
  const LightReceiver& at, double tolerance, long long& rays) const
{
  static_assert(FirstSunRays == PacketSize);
  const std::uint32_t seed = MixBits(HashPoint(at.Position, at.Normals.Shading));
  const OwenSobolSequence sequence(seed);
  std::array<glm::vec3, PacketSize> first;
  std::array<Ray, PacketSize> packet;
  for (std::uint32_t i = 0; i < PacketSize; ++i)
  {
    LightReceiver sample = at;
    sample.Sample = sequence.At(i);
    first[i] = UnshadowedSun(*this->Settings.Map, sample, packet[i]);
    const glm::vec2 outline = MoveToOutline(sample.Sample);
    Ray moved = packet[i];
    if (IsActive(moved) && outline != sample.Sample)
    {
      sample.Sample = outline;
      UnshadowedSun(*this->Settings.Map, sample, moved);
    }
    packet[i] = IsActive(moved) ? moved : packet[i];
  }
  std::array<float, PacketSize> transmittances{};
  this->SurfaceShading.TraceTransmittance16(packet.data(), transmittances.data(), rays);
  float least = 1.f;
  float most = 0.f;
  float largest = 0.f;
  for (std::uint32_t i = 0; i < PacketSize; ++i)
  {
    largest = std::max(largest, MaximumComponent(first[i]));
    first[i] *= transmittances[i];
    least = IsActive(packet[i]) ? std::min(least, transmittances[i]) : least;
    most = IsActive(packet[i]) ? std::max(most, transmittances[i]) : most;
  }
  bool usesFirst = least >= most;
  std::array<LightReceiver, PacketSize> receivers;
  receivers.fill(at);
  const StratifiedMean found = EstimateMeanOfBatches(
    [&](const glm::vec2* samples, std::uint32_t count, glm::vec3* values) {
      if (usesFirst)
      {
        std::copy(first.begin(), first.end(), values);
        usesFirst = false;
        return;
      }
      SetSamples(receivers, samples, count);
      this->SunContributions(receivers.data(), count, values, rays);
    },
    seed, usesFirst ? FirstSunRays : FirstPenumbraRays, MaximumSunRays, tolerance, 1.0,
    usesFirst ? 0.0 : (most - least) * largest);
  return { found.Mean, static_cast<float>(found.Error) };
}

// Rays are traced to the nearest hit: coincident surfaces may hide the emitter.
void Illumination::EmitterContributions(const LightReceiver* receivers, std::uint32_t count,
  glm::vec3* contributions, long long& rays) const
{
  std::array<EmitterTree::Sample, PacketSize> emitters;
  std::array<Ray, PacketSize> packet;
  std::array<Hit, PacketSize> hits;
  packet.fill(MakeInactiveRay());
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const SurfaceNormals& normals = receivers[i].Normals;
    const Ray origin = SpawnRay(receivers[i].Position, normals, normals.Geometric);
    emitters[i] =
      this->SampledEmitters->SampleDirection(origin.Origin, normals.Shading, receivers[i].Sample);
    if (emitters[i].Density > 0.f && glm::dot(emitters[i].Direction, normals.Geometric) > 0.f)
    {
      packet[i] = origin;
      packet[i].Direction = emitters[i].Direction;
    }
  }
  if (count == 1)
  {
    hits[0] = this->Rays.Intersect(packet[0]);
  }
  else if (count <= PacketSize / 2)
  {
    this->Rays.Intersect8(packet.data(), hits.data());
  }
  else
  {
    this->Rays.Intersect16(packet.data(), hits.data());
  }
  for (std::uint32_t i = 0; i < count; ++i)
  {
    contributions[i] = IsActive(packet[i]) ? this->EmitterContribution(receivers[i].Normals.Shading,
                                               packet[i], hits[i], emitters[i], rays)
                                           : glm::vec3(0.f);
  }
}

glm::vec3 Illumination::EmitterContribution(
  glm::vec3 normal, Ray ray, Hit hit, const EmitterTree::Sample& emitter, long long& rays) const
{
  const float cosine = glm::dot(normal, emitter.Direction);
  const float end = (1.f + EmitterDistanceTolerance) * emitter.Distance;
  float transmittance = 1.f;
  ++rays;
  for (int layer = 1; hit.IsHit() && hit.Distance <= end; ++layer)
  {
    if (!this->Rays.GetScene().Surfaces[hit.Surface].IsLineOrPoint)
    {
      const bool reached = hit.Surface == emitter.Target->Surface &&
        hit.Distance >= (1.f - EmitterDistanceTolerance) * emitter.Distance;
      if (reached)
      {
        const ShadedHit shaded = this->SurfaceShading.ShadeEmission(ray, hit);
        return transmittance * std::min(shaded.Color.a, 1.f) * cosine / Pi *
          PowerHeuristic(emitter.Density, cosine / Pi) / emitter.Density * shaded.Emission;
      }
      transmittance *= 1.f - Shading::ComputeOpacity(this->Rays, hit, ray);
    }
    if (layer == MaximumLayers || transmittance < MinimumTransmittance)
    {
      break;
    }
    ray = ContinueBehind(ray, hit);
    hit = this->Rays.Intersect(ray);
    ++rays;
  }
  return glm::vec3(0.f);
}

Illumination::SampledLight Illumination::EstimateSampledLight(
  glm::vec3 point, const SurfaceNormals& normals, double tolerance, long long& rays) const
{
  SampledLight result;
  const std::uint32_t seed = MixBits(HashPoint(point, normals.Shading));
  if (this->HasSuns())
  {
    result = this->EstimateSuns({ point, normals, glm::vec2(0.f) }, tolerance, rays);
  }
  if (this->HasSampledEmitters())
  {
    std::array<LightReceiver, PacketSize> receivers;
    receivers.fill({ point, normals, glm::vec2(0.f) });
    const StratifiedMean emitters = EstimateMeanOfBatches(
      [&](const glm::vec2* at, std::uint32_t count, glm::vec3* values) {
        SetSamples(receivers, at, count);
        this->EmitterContributions(receivers.data(), count, values, rays);
      },
      MixBits(seed), FirstEmitterRays, MaximumEmitterRays, tolerance, FirstEmitterErrorFraction);
    result.Mean += glm::vec3(emitters.Mean);
    result.Error = std::hypot(result.Error, static_cast<float>(emitters.Error));
  }
  return result;
}

void Illumination::SampleLights(
  const LightReceiver* receivers, std::uint32_t count, glm::vec3* estimates, long long& rays) const
{
  std::fill(estimates, estimates + count, glm::vec3(0.f));
  std::array<glm::vec3, PacketSize> contributions;
  const auto add = [&](auto contribute) {
    (this->*contribute)(receivers, count, contributions.data(), rays);
    std::transform(estimates, estimates + count, contributions.begin(), estimates, std::plus<>());
  };
  if (this->HasSuns())
  {
    add(&Illumination::SunContributions);
  }
  if (this->HasSampledEmitters())
  {
    add(&Illumination::EmitterContributions);
  }
}

glm::vec3 Illumination::SampleLights(
  glm::vec3 point, const SurfaceNormals& normals, std::uint32_t& random, long long& rays) const
{
  glm::vec3 estimate(0.f);
  if (this->HasSuns() || this->HasSampledEmitters())
  {
    const float u = NextFloat(random);
    const float v = NextFloat(random);
    const LightReceiver receiver{ point, normals, glm::vec2(u, v) };
    this->SampleLights(&receiver, 1, &estimate, rays);
  }
  return estimate;
}

glm::vec3 Illumination::TracePath(glm::vec3 point, const SurfaceNormals& normals, int bounces,
  std::uint32_t& random, long long& rays) const
{
  const float u = NextFloat(random);
  const float v = NextFloat(random);
  const Ray ray = SpawnRay(point, normals,
    FrameFromNormal(normals.Shading) * DiskToHemisphere(SampleUniformDiskConcentric(u, v)));
  const glm::vec3 sampled = this->SampleLights(point, normals, random, rays);
  float probability = 1.f;
  if (this->HasSuns() && bounces <= 1)
  {
    const float light = MaximumComponent(sampled);
    const float wanted = LastRayGain * this->LastRadiance;
    probability = wanted < light ? std::max(wanted / light, SmallestLastRayProbability)
                                 : this->UnlitProbability;
    if (NextFloat(random) >= probability)
    {
      return sampled;
    }
  }
  ++rays;
  return sampled +
    this->FollowPath(ray, this->Rays.Intersect(ray), normals.Shading, bounces, random, rays) /
    probability;
}

glm::vec3 Illumination::FollowPath(const Ray& ray, const Hit& hit, glm::vec3 normal, int bounces,
  std::uint32_t& random, long long& rays) const
{
  IrradianceFunction irradiance;
  if (bounces > 1)
  {
    irradiance = [&](glm::vec3 next, const SurfaceNormals& nextNormal) {
      return this->TracePath(next, nextNormal, bounces - 1, random, rays);
    };
  }
  return this->IncidentRadiance(ray, hit, normal, irradiance, rays);
}

}
