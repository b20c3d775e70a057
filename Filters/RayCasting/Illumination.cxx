// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Illumination.h"

#include "CosineDirections.h"

namespace penumbra
{
namespace
{

/// Translucent layers along one ray, and what of the light behind still matters.
constexpr int MaximumLayers = 64;
constexpr float LeastShare = 1.f / 1024.f;

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
    if (!(strength > 0.f) || surface.ScreenSpace)
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

Ray Illumination::RayFrom(glm::vec3 point, glm::vec3 normal, glm::vec3 direction)
{
  Ray ray;
  ray.Origin = point + GapAbove(point) * normal;
  ray.Direction = direction;
  return ray;
}

glm::vec3 Illumination::Along(Ray ray, Hit hit, const Arriving& arriving, long long& rays) const
{
  glm::vec3 sum(0.f);
  float left = 1.f;
  for (int layer = 0; layer < MaximumLayers; ++layer)
  {
    if (!hit.IsHit())
    {
      return sum + left * this->Settings.Environment;
    }
    if (!this->Rays.GetScene().Surfaces[hit.Surface].ScreenSpace)
    {
      const Appearance at = this->Shades.ShadeMatte(ray, hit, rays);
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
    ray.Near = hit.Beyond;
    hit = this->Rays.Intersect(ray);
    ++rays;
  }
  return sum;
}

glm::vec3 Illumination::FollowPath(
  glm::vec3 point, glm::vec3 normal, int bounces, std::uint32_t& random, long long& rays) const
{
  const float u = Uniform(random);
  const float v = Uniform(random);
  const Ray ray = RayFrom(point, normal, FrameOf(normal) * ToHemisphere(ToDisc(u, v)));
  ++rays;
  Arriving arriving;
  if (bounces > 1)
  {
    arriving = [&](glm::vec3 next, glm::vec3 nextNormal) {
      return this->FollowPath(next, nextNormal, bounces - 1, random, rays);
    };
  }
  return this->Along(ray, this->Rays.Intersect(ray), arriving, rays);
}

}
