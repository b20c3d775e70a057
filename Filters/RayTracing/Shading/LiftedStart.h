// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Where rays toward lights start on meshes with interpolated normals. If light is nearly along a triangle or behind it,
// but not behind the curved surface, they start at the latter: the triangle and its neighbors would shadow it along
// their edges. Otherwise, and if something is between the triangle and the curved surface, they start at the triangle.
#ifndef penumbra_LiftedStart_h
#define penumbra_LiftedStart_h

#include "Embree/RayScene.h"
#include "Geometry/SmoothSurface.h"
#include "HemisphereSampling.h"
#include "Shading.h"
#include "Surface.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>

namespace penumbra
{

/// Returns the distance from a hit to the curved surface of its triangle, on the side of the ray's origin. Returns none
/// without normals, or if the shading normal is on the other side.
inline std::optional<float> FindLift(
  const Surface& surface, const Hit& hit, const SurfaceNormals& atHit)
{
  if (surface.Normals.empty() || surface.IsRound() || surface.IsLineOrPoint ||
    !(glm::dot(atHit.Shading, atHit.Geometric) > 0.f))
  {
    return {};
  }
  std::array<glm::vec3, 3> normals = surface.GetNormals(hit.Primitive, surface.Normals);
  const glm::vec3 weights(1.f - hit.U - hit.V, hit.U, hit.V);
  const glm::vec3 mean = weights.x * normals[0] + weights.y * normals[1] + weights.z * normals[2];
  if (glm::dot(mean, atHit.Shading) < 0.f)
  {
    std::transform(normals.begin(), normals.end(), normals.begin(), std::negate<>());
  }
  return ComputeLift(surface.GetPoints(hit.Primitive), normals, weights, atHit.Geometric);
}

/// Moves `point`, where rays toward a light in `direction` (unit) start, from the triangle of `hit` to the curved
/// surface that its normals describe, see ComputeLift(). Returns false if they start at the triangle, as without a hit.
/// Adds the number of rays traced to `rays`.
inline bool LiftRayStart(const Shading& shading, glm::vec3& point, const Hit& hit,
  const SurfaceNormals& normals, glm::vec3 direction, long long& rays)
{
  const float fraction = GetLiftedFraction(glm::dot(direction, normals.Geometric));
  if (!(fraction > 0.f && hit.IsHit()))
  {
    return false;
  }
  const std::optional<float> lift =
    FindLift(shading.GetRays().GetSurfaces()[hit.Surface], hit, normals);
  if (!lift)
  {
    return false;
  }
  const Ray ray{ point + RayOriginOffset(point) * normals.Geometric, normals.Geometric, 0.f,
    fraction * *lift };
  if (ray.Far > 0.f && shading.TraceTransmittance(ray, rays) < 1.f)
  {
    return false;
  }
  point = ray.Origin + ray.Far * ray.Direction;
  return true;
}

}
#endif
