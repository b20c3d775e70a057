// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PixelCandidates.h"

#include "Embree/RayScene.h"
#include "Execution/ParallelFor.h"
#include "Gathering/IrradianceConstants.h"
#include "Scene.h"
#include "Surface.h"

namespace penumbra
{
namespace
{

bool IsInLevel(int x, int y, int stride, int level)
{
  if (level == 0)
  {
    return true;
  }
  const bool oddX = (x / stride & 1) != 0;
  const bool oddY = (y / stride & 1) != 0;
  return level % 2 == 1 ? oddX && oddY : oddX != oddY;
}

}

int LevelStride(int level)
{
  return CoarsestStride >> (level + 1) / 2;
}

bool FindCandidate(const RayScene& rays, glm::dvec2 at, RecordCandidate& site)
{
  const Scene& scene = rays.GetScene();
  const Camera& camera = scene.ViewCamera;
  Ray ray;
  ray.Origin = glm::vec3(camera.RayOrigin(at));
  ray.Direction = glm::vec3(camera.RayDirection(at));
  ray.Near = static_cast<float>(std::max(camera.Near - camera.DepthOfRayOrigins(), 0.0));
  Hit hit = rays.Intersect(ray);
  while (hit.IsHit() && scene.Surfaces[hit.Surface].IsLineOrPoint)
  {
    ray = ContinueBehind(ray, hit);
    hit = rays.Intersect(ray);
  }
  if (!hit.IsHit())
  {
    return false;
  }
  const Surface& surface = scene.Surfaces[hit.Surface];
  const std::array<glm::vec3, 3> points = surface.GetPoints(hit.Primitive);
  const glm::dvec3 a(points[0]);
  const glm::dvec3 normal = surface.IsRound()
    ? glm::dvec3(rays.GetNormal(ray, hit))
    : glm::cross(glm::dvec3(points[1]) - a, glm::dvec3(points[2]) - a);
  const double length = glm::length(normal);
  if (!(length > 0.0))
  {
    return false;
  }
  const double facing = glm::dot(normal, glm::dvec3(ray.Direction));
  site.Position = ray.Origin + hit.Distance * ray.Direction;
  const glm::dvec3 geometric = (facing > 0.0 ? -1.0 : 1.0) / length * normal;
  site.GeometricNormal = geometric;
  site.Normal = rays.GetSmoothNormal(hit, geometric);
  const double cosine = std::abs(facing) / (length * glm::length(glm::dvec3(ray.Direction)));
  const double depth = hit.Distance + camera.DepthOfRayOrigins();
  const double pixel = camera.PixelSize * (camera.Parallel ? 1.0 : depth);
  site.Pixel = static_cast<float>(pixel / std::sqrt(std::max(cosine, MinimumViewCosine)));
  if (!camera.Parallel)
  {
    site.MaximumRadius =
      static_cast<float>((1.0 - NearestFraction) * depth * glm::length(glm::dvec3(ray.Direction)));
  }
  return true;
}

std::vector<RecordCandidate> CandidatesInImage(
  const RayScene& rays, int level, const ProgressCallback& progress)
{
  const Camera& camera = rays.GetScene().ViewCamera;
  const int stride = LevelStride(level);
  const int rows = (camera.Height + stride - 1) / stride;
  std::vector<std::vector<RecordCandidate>> found(rows);
  const bool done = ParallelForWithProgress(rows, 0.0, 0.0, progress, [&](int row) {
    for (int x = 0; x < camera.Width; x += stride)
    {
      RecordCandidate site;
      const int y = row * stride;
      if (IsInLevel(x, y, stride, level) && FindCandidate(rays, { x + .5, y + .5 }, site))
      {
        found[row].push_back(site);
      }
    }
  });
  if (!done)
  {
    throw Stopped();
  }
  std::vector<RecordCandidate> sites;
  for (const std::vector<RecordCandidate>& row : found)
  {
    sites.insert(sites.end(), row.begin(), row.end());
  }
  return sites;
}

}
