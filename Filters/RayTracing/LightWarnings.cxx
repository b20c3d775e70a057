// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LightWarnings.h"

#include "Scene.h"
#include "Shading/RayTracingConstants.h"
#include "Surface.h"

#include "vtkLine.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkTriangle.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>

namespace penumbra
{
namespace
{

/// Returns true if the bounding box of three points, enlarged by `radius`, contains `center`.
bool IsNearBox(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 center, float radius)
{
  const glm::vec3 low = glm::min(a, glm::min(b, c)) - radius;
  const glm::vec3 high = glm::max(a, glm::max(b, c)) + radius;
  return glm::all(glm::lessThanEqual(low, center)) && glm::all(glm::lessThanEqual(center, high));
}

/// Returns the distance of a point from a triangle with corners a, b and c.
double DistanceToTriangle(
  vtkTriangle* triangle, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 point)
{
  triangle->GetPoints()->SetPoint(0, a.x, a.y, a.z);
  triangle->GetPoints()->SetPoint(1, b.x, b.y, b.z);
  triangle->GetPoints()->SetPoint(2, c.x, c.y, c.z);
  const double x[3] = { point.x, point.y, point.z };
  double closest[3];
  double coordinates[3];
  double weights[3];
  double square = 0.0;
  int subId = 0;
  if (triangle->EvaluatePosition(x, closest, subId, coordinates, square, weights) >= 0)
  {
    return std::sqrt(square);
  }
  // The triangle has no area.
  return std::min({ glm::distance(point, a), glm::distance(point, b), glm::distance(point, c) });
}

/// Returns the distance of a point from the segment between a and b.
double DistanceToSegment(glm::vec3 a, glm::vec3 b, glm::vec3 point)
{
  const double x[3] = { point.x, point.y, point.z };
  const double p[3] = { a.x, a.y, a.z };
  const double q[3] = { b.x, b.y, b.z };
  double t = 0.0;
  double closest[3];
  return std::sqrt(vtkLine::DistanceToLine(x, p, q, t, closest));
}

bool Overlaps(const Surface& surface, const Light& light)
{
  if (surface.IsLineOrPoint)
  {
    return false;
  }
  vtkNew<vtkTriangle> triangle;
  for (std::size_t i = 0; i < surface.GetNumberOfPrimitives(); ++i)
  {
    if (surface.Instances && i % surface.Triangles.size() == 0)
    {
      const AxisAlignedBox box = surface.Instances->GetBox(i / surface.Triangles.size());
      if (!IsNearBox(box.Low, box.High, box.High, light.Position, light.Radius))
      {
        i += surface.Triangles.size() - 1;
        continue;
      }
    }
    const glm::uvec3 corners = surface.GetCorners(static_cast<std::uint32_t>(i));
    const auto [a, b, c] = surface.GetPoints(static_cast<std::uint32_t>(i));
    const float thickness = std::max(surface.GetRadius(corners.x), surface.GetRadius(corners.y));
    const float radius = light.Radius + thickness;
    if (!IsNearBox(a, b, c, light.Position, radius))
    {
      continue;
    }
    const double distance = surface.IsRound()
      ? DistanceToSegment(a, b, light.Position)
      : DistanceToTriangle(triangle, a, b, c, light.Position);
    if (distance <= radius)
    {
      return true;
    }
  }
  return false;
}

bool IsPositive(glm::vec3 color)
{
  return color.x > 0.f || color.y > 0.f || color.z > 0.f;
}

/// What the search found at one pixel.
enum class Finding
{
  NoReflector, ///< no hit, or a black surface
  Dark,
  Lit
};

Finding SearchLight(
  const RayScene& rays, const Shading& shading, const Illumination* indirect, const Ray& ray)
{
  const Hit hit = SkipLinesAndPoints(rays, ray, rays.Intersect(ray));
  if (!hit.IsHit())
  {
    return Finding::NoReflector;
  }
  long long count = 0;
  const ShadedHit shaded = shading.Shade(ray, hit, count, nullptr, Shading::Terms::Diffuse);
  if (IsPositive(glm::vec3(shaded.Color)))
  {
    return Finding::Lit;
  }
  if (!IsPositive(shaded.Reflectance) || shaded.Color.a < 1.f)
  {
    return Finding::NoReflector;
  }
  const glm::vec3 point = ray.Origin + hit.Distance * ray.Direction;
  const glm::vec3 geometric = glm::normalize(shaded.GeometricNormal);
  const SurfaceNormals normals(glm::vec3(rays.GetSmoothNormal(hit, geometric)), geometric);
  std::uint32_t random = HashPoint(point, geometric);
  for (int path = 0; path < MissingLightPaths && indirect; ++path)
  {
    if (IsPositive(
          indirect->TracePath(point, normals, indirect->GetSettings().Bounces, random, count)))
    {
      return Finding::Lit;
    }
  }
  return Finding::Dark;
}

}

std::vector<std::string> DescribeLightOverlaps(const Scene& scene)
{
  std::vector<std::string> sentences;
  for (const Light& light : scene.Lights)
  {
    if (light.Kind == Light::Kinds::Positional && light.CastsPenumbra() &&
      std::any_of(scene.Surfaces.begin(), scene.Surfaces.end(),
        [&light](const Surface& surface) { return Overlaps(surface, light); }))
    {
      const glm::dvec3 center = scene.ToWorld(light.Position);
      std::ostringstream text;
      text << "The light at (" << center.x << ", " << center.y << ", " << center.z
           << ") with a radius of " << light.Radius / scene.Scale
           << " contains or touches a surface. Inside the light, surfaces are fully lit and cast "
              "no shadow. Reduce the radius or move the light.";
      sentences.push_back(text.str());
    }
  }
  return sentences;
}

FoundLight FindLight(const RayScene& rays, bool shadows, const Illumination* indirect,
  const std::function<bool(glm::ivec2)>& isAsked)
{
  FoundLight found;
  found.IsLit = rays.GetScene().EnvironmentReflections != nullptr;
  const Camera& camera = rays.GetScene().ViewCamera;
  const Shading shading(rays, shadows);
  for (int k = 0; k < MissingLightGridSide * MissingLightGridSide && !found.IsLit; ++k)
  {
    const glm::dvec2 cell(k % MissingLightGridSide, k / MissingLightGridSide);
    const glm::dvec2 at =
      (cell + .5) / double(MissingLightGridSide) * glm::dvec2(camera.Width, camera.Height);
    if (isAsked && !isAsked(glm::ivec2(at)))
    {
      continue;
    }
    Ray ray;
    ray.Origin = glm::vec3(camera.RayOrigin(at));
    ray.Direction = glm::vec3(camera.RayDirection(at));
    const Finding finding = SearchLight(rays, shading, indirect, ray);
    found.IsLit = finding == Finding::Lit;
    found.IsDark = found.IsDark || finding == Finding::Dark;
  }
  return found;
}

std::string DescribeMissingLight(const FoundLight& found)
{
  return found.IsDark && !found.IsLit
    ? "The visible surfaces are black, because no light reaches them. Move lights "
      "out of closed surfaces, add a light or a surface with ambient color where the camera looks, "
      "or open closed spaces to EnvironmentColor or Environment."
    : std::string();
}

std::string DescribeUnlitLines(const Scene& scene)
{
  const auto isUnlit = [](const Surface& surface) {
    return surface.IsLineOrPoint && !surface.Front.Lighting;
  };
  return !scene.Surfaces.empty() &&
      std::all_of(scene.Surfaces.begin(), scene.Surfaces.end(), isUnlit)
    ? "Indirect light has no effect, because no surface has lighting. Lines and points need "
      "normals, LineRadius or PointRadius for it, and a property with lighting."
    : std::string();
}

}
