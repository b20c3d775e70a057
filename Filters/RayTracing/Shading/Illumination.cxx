// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Illumination.h"

#include "HemisphereSampling.h"
#include "OwenSobolSequence.h"

namespace penumbra
{
namespace
{

/// Translucent layers along one ray, and what of the light behind still matters.
constexpr int MaximumLayers = 64;
constexpr float LeastShare = 1.f / 1024.f;

/// Rays to the suns of the environment's picture: of the first round, and in all.
constexpr std::uint32_t FirstSuns = 16;
constexpr std::uint32_t MostSuns = 4096;

constexpr float Pi = 3.14159265f;

/// More triangles that shine are surfaces, not lamps.
constexpr std::size_t MostEmitters = 8;

/// Greatest channel of what `surface` sends out by itself.
float StrengthOf(const Surface& surface)
{
  const Material& material = surface.Front;
  const glm::vec3 light = material.Ambient * material.AmbientColor +
    (material.Lighting ? 0.f : material.Diffuse) * material.DiffuseColor;
  return std::max({ light.x, light.y, light.z });
}

}

Illumination::Illumination(const RayScene& rays, const IlluminationSettings& settings)
  : Rays(rays),
    Shades(rays, settings.Shadows),
    Settings(settings)
{
  for (const Surface& surface : rays.GetScene().Surfaces)
  {
    const float strength = StrengthOf(surface);
    if (!(strength > 0.f) || surface.IsLineOrPoint)
    {
      continue;
    }
    if (this->Emitters.size() + surface.Triangles.size() > MostEmitters)
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
  Ray ray, Hit hit, const IrradianceFunction& arriving, long long& rays) const
{
  glm::vec3 sum(0.f);
  float left = 1.f;
  for (int layer = 0; layer < MaximumLayers; ++layer)
  {
    if (!hit.IsHit())
    {
      const EnvironmentMap* picture = this->Settings.Picture.get();
      return sum +
        left * (picture ? picture->ClampedRadiance(ray.Direction) : this->Settings.Environment);
    }
    if (!this->Rays.GetScene().Surfaces[hit.Surface].IsLineOrPoint)
    {
      const ShadedHit at = this->Shades.ShadeDiffuse(ray, hit, rays);
      glm::vec3 light(at.Color);
      const glm::vec3 reflectance = this->Settings.Albedo * at.Reflectance;
      if (arriving && reflectance != glm::vec3(0.f))
      {
        light += reflectance *
          arriving(ray.Origin + hit.Distance * ray.Direction, glm::normalize(at.GeometricNormal));
      }
      const float opacity = std::min(at.Color.a, 1.f);
      sum += left * opacity * light;
      left *= 1.f - opacity;
      if (left < LeastShare)
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
  glm::vec3 point, glm::vec3 normal, glm::vec2 at, long long& rays) const
{
  const EnvironmentMap::Sun sun = this->Settings.Picture->SampleSun(at);
  const float cosine = glm::dot(normal, sun.Direction);
  return cosine > 0.f
    ? this->Shades.TraceTransmittance(SpawnRay(point, normal, sun.Direction), rays) * cosine / Pi *
      sun.Weight
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
  const OwenSobolSequence places(MixBits(HashPoint(point, normal)));
  glm::dvec3 sum(0.0);
  std::vector<float> greys;
  for (std::uint32_t count = FirstSuns;; count *= 2)
  {
    while (greys.size() < count)
    {
      const glm::vec3 light = this->SunContribution(
        point, normal, places.At(static_cast<std::uint32_t>(greys.size())), rays);
      sum += light;
      greys.push_back((light.x + light.y + light.z) / 3.f);
    }
    const std::uint32_t partner = OwenSobolSequence::FindPartner(count);
    double differences = 0.0;
    for (std::uint32_t i = 0; i < count; ++i)
    {
      differences += .5 * std::pow(greys[i] - greys[i ^ partner], 2.0);
    }
    result.Error = static_cast<float>(std::sqrt(differences) / count);
    if (result.Error <= tolerance || count >= MostSuns)
    {
      break;
    }
  }
  result.Mean = sum / static_cast<double>(greys.size());
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
  IrradianceFunction arriving;
  if (bounces > 1)
  {
    arriving = [&](glm::vec3 next, glm::vec3 nextNormal) {
      return this->TracePath(next, nextNormal, bounces - 1, random, rays);
    };
  }
  const glm::vec3 suns = this->SampleSuns(point, normal, random, rays);
  return suns + this->IncidentRadiance(ray, this->Rays.Intersect(ray), arriving, rays);
}

}
