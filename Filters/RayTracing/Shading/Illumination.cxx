// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Illumination.h"

#include "HemisphereSampling.h"
#include "OwenSobolSequence.h"
#include "RayTracingConstants.h"

#include <glm/gtc/constants.hpp>

namespace penumbra
{
namespace
{

constexpr float Pi = glm::pi<float>();

/// Returns the largest channel of the radiance that `surface` emits.
float ComputeEmission(const Surface& surface)
{
  const Material& material = surface.Front;
  const glm::vec3 radiance = material.Ambient * material.AmbientColor +
    (material.Lighting ? 0.f : material.Diffuse) * material.DiffuseColor;
  return std::max({ radiance.x, radiance.y, radiance.z });
}

}

Illumination::Illumination(const RayScene& rays, const IlluminationSettings& settings)
  : Rays(rays),
    SurfaceShading(rays, settings.Shadows),
    Settings(settings)
{
  for (const Surface& surface : rays.GetScene().Surfaces)
  {
    const float strength = ComputeEmission(surface);
    if (!(strength > 0.f) || surface.IsLineOrPoint)
    {
      continue;
    }
    if (surface.IsRound() || this->Emitters.size() + surface.Triangles.size() > MaximumEmitters)
    {
      this->Emitters.clear();
      return;
    }
    for (const glm::uvec3 corners : surface.Triangles)
    {
      this->Emitters.push_back({ { surface.Positions[corners.x], surface.Positions[corners.y],
                                   surface.Positions[corners.z] },
        strength });
    }
  }
}

Ray Illumination::SpawnRay(glm::vec3 point, glm::vec3 normal, glm::vec3 direction)
{
  Ray ray;
  ray.Origin = point + RayOriginOffset(point) * normal;
  ray.Direction = direction;
  return ray;
}

glm::vec3 Illumination::IncidentRadiance(
  Ray ray, Hit hit, const IrradianceFunction& irradiance, long long& rays) const
{
  glm::vec3 sum(0.f);
  float transmittance = 1.f;
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
      const glm::vec3 reflectance = this->Settings.Albedo * shaded.Reflectance;
      if (irradiance && reflectance != glm::vec3(0.f))
      {
        radiance += reflectance *
          irradiance(
            ray.Origin + hit.Distance * ray.Direction, glm::normalize(shaded.GeometricNormal));
      }
      const float opacity = std::min(shaded.Color.a, 1.f);
      sum += transmittance * opacity * radiance;
      transmittance *= 1.f - opacity;
      if (transmittance < MinimumTransmittance)
      {
        return sum;
      }
    }
    ray.Near = hit.NextNear;
    hit = this->Rays.Intersect(ray);
    ++rays;
  }
  return sum;
}

glm::vec3 Illumination::SunContribution(
  glm::vec3 point, glm::vec3 normal, glm::vec2 sample, long long& rays) const
{
  const EnvironmentMap::Sun sun = this->Settings.Map->SampleSun(sample);
  const float cosine = glm::dot(normal, sun.Direction);
  return cosine > 0.f
    ? this->SurfaceShading.TraceTransmittance(SpawnRay(point, normal, sun.Direction), rays) *
      cosine / Pi * sun.Weight
    : glm::vec3(0.f);
}

Illumination::Sunlight Illumination::EstimateSunlight(
  glm::vec3 point, glm::vec3 normal, double tolerance, long long& rays) const
{
  Sunlight result;
  if (!this->HasSuns())
  {
    return result;
  }
  const OwenSobolSequence samples(MixBits(HashPoint(point, normal)));
  glm::dvec3 sum(0.0);
  std::vector<float> grays;
  for (std::uint32_t count = FirstSunRays;; count *= 2)
  {
    while (grays.size() < count)
    {
      const glm::vec3 light = this->SunContribution(
        point, normal, samples.At(static_cast<std::uint32_t>(grays.size())), rays);
      sum += light;
      grays.push_back((light.x + light.y + light.z) / 3.f);
    }
    result.Error =
      static_cast<float>(std::sqrt(OwenSobolSequence::SumPairDifferences(grays)) / count);
    if (result.Error <= tolerance || count >= MaximumSunRays)
    {
      break;
    }
  }
  result.Mean = sum / static_cast<double>(grays.size());
  return result;
}

glm::vec3 Illumination::SampleSuns(
  glm::vec3 point, glm::vec3 normal, std::uint32_t& random, long long& rays) const
{
  if (!this->HasSuns())
  {
    return glm::vec3(0.f);
  }
  const float u = NextFloat(random);
  const float v = NextFloat(random);
  return this->SunContribution(point, normal, { u, v }, rays);
}

glm::vec3 Illumination::TracePath(
  glm::vec3 point, glm::vec3 normal, int bounces, std::uint32_t& random, long long& rays) const
{
  const float u = NextFloat(random);
  const float v = NextFloat(random);
  const Ray ray = SpawnRay(
    point, normal, FrameFromNormal(normal) * DiskToHemisphere(SampleUniformDiskConcentric(u, v)));
  ++rays;
  IrradianceFunction irradiance;
  if (bounces > 1)
  {
    irradiance = [&](glm::vec3 next, glm::vec3 nextNormal) {
      return this->TracePath(next, nextNormal, bounces - 1, random, rays);
    };
  }
  const glm::vec3 suns = this->SampleSuns(point, normal, random, rays);
  return suns + this->IncidentRadiance(ray, this->Rays.Intersect(ray), irradiance, rays);
}

}
