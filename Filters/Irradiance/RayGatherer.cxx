// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RayGatherer.h"

#include "CosineDirections.h"
#include "RayScene.h"

namespace penumbra
{
namespace
{

constexpr std::size_t PacketSize = 16;

/// On past lines and points, which block nothing.
Hit PassMarks(const RayScene& rays, Ray ray, Hit hit)
{
  while (hit.IsHit() && rays.GetScene().Surfaces[hit.Surface].ScreenSpace)
  {
    ray.Near = hit.Beyond;
    hit = rays.Intersect(ray);
  }
  return hit;
}

/// Unit normal of the triangle that was hit, either side.
glm::vec3 NormalAt(const Scene& scene, const Hit& hit)
{
  const Surface& surface = scene.Surfaces[hit.Surface];
  const glm::uvec3 corners = surface.Triangles[hit.Triangle];
  const glm::vec3 a = surface.Positions[corners.x];
  const glm::vec3 n =
    glm::cross(surface.Positions[corners.y] - a, surface.Positions[corners.z] - a);
  const float length = glm::length(n);
  return length > 0.f ? n / length : glm::vec3(0.f);
}

}

OcclusionGatherer::OcclusionGatherer(const RayScene& scene, float reach)
  : Rays(scene),
    Reach(reach)
{
}

void OcclusionGatherer::Gather(glm::vec3 point, glm::vec3 normal,
  const std::vector<glm::vec3>& directions, std::vector<Sight>& sights) const
{
  sights.resize(directions.size());
  const glm::vec3 origin = point + GapAbove(point) * normal;
  Ray rays[PacketSize];
  Hit hits[PacketSize];
  for (std::size_t first = 0; first < directions.size(); first += PacketSize)
  {
    const std::size_t count = std::min(PacketSize, directions.size() - first);
    for (std::size_t i = 0; i < PacketSize; ++i)
    {
      rays[i] = i < count ? Ray{ origin, directions[first + i], 0.f, this->Reach }
                          : Ray{ origin, normal, 1.f, 0.f };
    }
    this->Rays.Intersect16(rays, hits);
    for (std::size_t i = 0; i < count; ++i)
    {
      const Hit hit = PassMarks(this->Rays, rays[i], hits[i]);
      Sight& sight = sights[first + i];
      sight = Sight();
      if (hit.IsHit())
      {
        sight.Distance = hit.Distance;
        sight.Normal = NormalAt(this->Rays.GetScene(), hit);
        sight.Radiance = glm::vec3(1.f);
      }
    }
  }
}

}
