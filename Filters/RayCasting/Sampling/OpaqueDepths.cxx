// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OpaqueDepths.h"

#include "Camera.h"
#include "Scene.h"
#include "Surface.h"

#include <algorithm>
#include <limits>

namespace penumbra
{

std::vector<double> FindOpaqueDepths(const RayScene& rays, const std::vector<glm::dvec2>& points)
{
  const Scene& scene = rays.GetScene();
  const Camera& camera = scene.ViewCamera;
  // As in VTK, whose translucent actors leave the depth buffer as it is. Lines and points are moved
  // toward the camera, and would hide the labels of these points.
  std::vector<char> hides;
  for (const Surface& surface : scene.Surfaces)
  {
    hides.push_back(!surface.HidesLines && !surface.IsLineOrPoint &&
      (surface.ForceOpaque || !surface.IsTranslucent()));
  }
  std::vector<double> depths;
  depths.reserve(points.size());
  for (const glm::dvec2 point : points)
  {
    Ray ray;
    ray.Origin = glm::vec3(camera.RayOrigin(point));
    ray.Direction = glm::vec3(camera.RayDirection(point));
    ray.Near = static_cast<float>(std::max(camera.Near - camera.DepthOfRayOrigins(), 0.0));
    Hit hit = rays.Intersect(ray);
    while (hit.IsHit() && !hides[hit.Surface])
    {
      ray = ContinueBehind(ray, hit);
      hit = rays.Intersect(ray);
    }
    depths.push_back(hit.IsHit() ? camera.DepthOfRayOrigins() + hit.Distance
                                 : std::numeric_limits<double>::infinity());
  }
  return depths;
}

}
