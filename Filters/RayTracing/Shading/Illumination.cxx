// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Illumination.h"

#include "Embree/CoincidentSurfaces.h"
#include "HemisphereSampling.h"
#include "Lights/EmissiveSurfaces.h"
#include "RayTracingConstants.h"
#include "Scene.h"
#include "Surface.h"
#include "TranslucentOcclusion.h"
#include "Vectors.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

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

/// Returns true if the emitters of a surface of an opaque scene are visible wherever no surface is before them: its
/// triangles have one color on both sides, and no other surface coincides with them.
bool IsPlainEmitter(const Shading& shading, std::uint32_t index)
{
  const RayScene& rays = shading.GetRays();
  const Surface& surface = rays.GetSurfaces()[index];
  return shading.HasUniformEmission(index) && surface.Frontfaces && surface.Backfaces &&
    !surface.IsRound() && !surface.Instances &&
    rays.GetCoincidentSurfaces().DepthTolerance(index) == 0.f;
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
    this->PlainEmitters.assign(this->Rays.GetSurfaces().size(), 0);
    const bool isOpaque = !HasTranslucentOccluders(this->Rays.GetSurfaces());
    std::uint32_t last = Hit::None;
    for (const Emitter& emitter : found.Bright)
    {
      if (emitter.Surface != last)
      {
        last = emitter.Surface;
        this->PlainEmitters[last] = isOpaque && IsPlainEmitter(this->SurfaceShading, last);
      }
    }
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
    if (!this->Rays.GetSurfaces()[hit.Surface].IsLineOrPoint)
    {
      const ShadedHit shaded =
        this->SurfaceShading.Shade(ray, hit, rays, nullptr, Shading::Terms::Diffuse);
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
