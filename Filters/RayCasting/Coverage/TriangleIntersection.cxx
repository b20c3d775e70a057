// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleIntersection.h"

#include "Embree/RoundIntersection.h"
#include "RoundOutlines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace penumbra
{

namespace
{

double Cross(glm::dvec2 a, glm::dvec2 b)
{
  return a.x * b.y - a.y * b.x;
}

/// A triangle in pixel coordinates, with a value that is linear in them: 1/depth in perspective
/// projection, depth in parallel projection.
struct ProjectedTriangle
{
  glm::dvec2 Corners[3];
  double DoubleArea; ///< signed
  glm::dvec2 Gradient;
  double ValueAtOrigin;
};

bool ProjectTriangle(
  const Scene& scene, PrimitiveId id, glm::dvec2 origin, ProjectedTriangle& projected)
{
  const Surface& surface = scene.Surfaces[id.Surface];
  const glm::uvec3 triangle = surface.Triangles[id.Primitive];
  double linear[3];
  for (int i = 0; i < 3; ++i)
  {
    const glm::dvec3 p(surface.Positions[triangle[i]]);
    const double depth = scene.ViewCamera.Depth(p);
    if (!scene.ViewCamera.Parallel && depth <= scene.ViewCamera.Near)
    {
      return false;
    }
    projected.Corners[i] = scene.ViewCamera.Project(p) - origin;
    linear[i] = scene.ViewCamera.Parallel ? depth : 1.0 / depth;
  }
  const glm::dvec2 d = projected.Corners[1] - projected.Corners[0];
  const glm::dvec2 e = projected.Corners[2] - projected.Corners[0];
  projected.DoubleArea = Cross(d, e);
  if (std::abs(projected.DoubleArea) < 1e-9)
  {
    return false; // edge-on
  }
  const double u = linear[1] - linear[0];
  const double v = linear[2] - linear[0];
  projected.Gradient = glm::dvec2(u * e.y - v * d.y, v * d.x - u * e.x) / projected.DoubleArea;
  projected.ValueAtOrigin = linear[0] - glm::dot(projected.Gradient, projected.Corners[0]);
  return true;
}

/// Narrows [enter, leave] to the range of t for which p + t * d is inside the triangle.
void ClipToTriangle(
  const ProjectedTriangle& triangle, glm::dvec2 p, glm::dvec2 d, double& enter, double& leave)
{
  for (int i = 0; i < 3; ++i)
  {
    const glm::dvec2 corner = triangle.Corners[i];
    const glm::dvec2 side = triangle.Corners[(i + 1) % 3] - corner;
    const double sign = triangle.DoubleArea > 0.0 ? 1.0 : -1.0;
    const double distance = sign * Cross(side, p - corner);
    const double rate = sign * Cross(side, d);
    if (rate > 0.0)
    {
      enter = std::max(enter, -distance / rate);
    }
    else if (rate < 0.0)
    {
      leave = std::min(leave, -distance / rate);
    }
    else if (distance < 0.0)
    {
      leave = enter;
    }
  }
}

// Front surfaces of convex shapes are convex, in perspective after a projective map. Their largest
// depth in a pixel is that of a corner. Beyond the outline, the depth of the shape is bounded by
// its farthest end.
double MaximumRoundDepthInPixel(const Scene& scene, PrimitiveId id, glm::dvec2 origin)
{
  const RoundShape shape = scene.Surfaces[id.Surface].GetRoundShape(id.Primitive);
  const Camera& camera = scene.ViewCamera;
  double largest = 0.0;
  for (int corner = 0; corner < 4; ++corner)
  {
    const glm::dvec2 p = origin + glm::dvec2(corner & 1, corner >> 1);
    const RoundIntersection hit(shape, camera.RayOrigin(p), camera.RayDirection(p));
    if (!hit.IsHit || hit.Enter < 0.0)
    {
      return std::max(camera.Depth(glm::dvec3(shape.A)) + shape.RadiusA,
        camera.Depth(glm::dvec3(shape.B)) + shape.RadiusB);
    }
    largest = std::max(largest, hit.Enter + camera.DepthOfRayOrigins());
  }
  return largest;
}

}

bool HaveCommonEdge(const Scene& scene, PrimitiveId a, PrimitiveId b)
{
  const Surface& s = scene.Surfaces[a.Surface];
  const Surface& t = scene.Surfaces[b.Surface];
  if (s.IsRound() || t.IsRound())
  {
    return false;
  }
  int shared = 0;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      shared +=
        s.Positions[s.Triangles[a.Primitive][i]] == t.Positions[t.Triangles[b.Primitive][j]];
    }
  }
  return shared >= 2;
}

double MaximumDepthInPixel(const Scene& scene, PrimitiveId id, glm::dvec2 origin)
{
  if (scene.Surfaces[id.Surface].IsRound())
  {
    return MaximumRoundDepthInPixel(scene, id, origin);
  }
  ProjectedTriangle projected;
  if (!ProjectTriangle(scene, id, origin, projected))
  {
    return std::numeric_limits<double>::infinity();
  }
  const glm::dvec2 low = glm::min(projected.Gradient, 0.0);
  const glm::dvec2 high = glm::max(projected.Gradient, 0.0);
  if (scene.ViewCamera.Parallel)
  {
    return projected.ValueAtOrigin + high.x + high.y;
  }
  const double minimum = projected.ValueAtOrigin + low.x + low.y;
  return minimum > 0.0 ? 1.0 / minimum : std::numeric_limits<double>::infinity();
}

bool IntersectTriangles(
  const Scene& scene, PrimitiveId a, PrimitiveId b, glm::dvec2 origin, PixelSegment& segment)
{
  ProjectedTriangle s;
  ProjectedTriangle t;
  if (HaveCommonEdge(scene, a, b) || !ProjectTriangle(scene, a, origin, s) ||
    !ProjectTriangle(scene, b, origin, t))
  {
    return false;
  }
  const glm::dvec2 gradient = s.Gradient - t.Gradient;
  const double square = glm::dot(gradient, gradient);
  const double level = s.ValueAtOrigin - t.ValueAtOrigin;
  if (!(square > 1e-24 * (glm::dot(s.Gradient, s.Gradient) + glm::dot(t.Gradient, t.Gradient))))
  {
    return false; // parallel
  }
  const glm::dvec2 foot = -gradient * (level / square);
  const glm::dvec2 direction = glm::dvec2(-gradient.y, gradient.x) / std::sqrt(square);
  const double along = glm::dot(glm::dvec2(0.5) - foot, direction);
  const glm::dvec2 center = foot + along * direction;
  double enter = -1.0;
  double leave = 1.0;
  ClipToTriangle(s, center, direction, enter, leave);
  ClipToTriangle(t, center, direction, enter, leave);
  if (!(leave - enter > 1e-6))
  {
    return false;
  }
  segment = { center + enter * direction, center + leave * direction };
  return ClipToPixel(segment);
}

void IntersectSphere(const Scene& scene, PrimitiveId a, PrimitiveId b, glm::dvec2 origin,
  std::vector<PixelSegment>& segments)
{
  const auto isSphere = [&](PrimitiveId id) {
    const Surface& surface = scene.Surfaces[id.Surface];
    return surface.IsRound() && surface.Segments.empty();
  };
  if (!isSphere(a))
  {
    std::swap(a, b);
  }
  if (!isSphere(a) || (scene.Surfaces[b.Surface].IsRound() && !isSphere(b)))
  {
    return;
  }
  const RoundShape sphere = scene.Surfaces[a.Surface].GetRoundShape(a.Primitive);
  const glm::dvec3 center(sphere.A);
  const double radius = sphere.RadiusA;
  glm::dvec3 normal;
  double distance = 0.0; // of the plane of the intersection from the center
  const Surface& other = scene.Surfaces[b.Surface];
  if (isSphere(b))
  {
    const RoundShape second = other.GetRoundShape(b.Primitive);
    const glm::dvec3 d = glm::dvec3(second.A) - center;
    const double length = glm::length(d);
    if (!(length > 0.0))
    {
      return;
    }
    normal = d / length;
    distance = 0.5 * (length + (radius - second.RadiusA) * (radius + second.RadiusA) / length);
  }
  else
  {
    const glm::uvec3 corners = other.Triangles[b.Primitive];
    const glm::dvec3 p(other.Positions[corners.x]);
    const glm::dvec3 n = glm::cross(
      glm::dvec3(other.Positions[corners.y]) - p, glm::dvec3(other.Positions[corners.z]) - p);
    const double length = glm::length(n);
    if (!(length > 0.0))
    {
      return;
    }
    normal = n / length;
    distance = glm::dot(p - center, normal);
  }
  const double square = radius * radius - distance * distance;
  if (!(square > 0.0))
  {
    return;
  }
  std::vector<ProjectedEdge> edges;
  ProjectCircle(center + distance * normal, std::sqrt(square), normal, scene.ViewCamera, origin,
    origin + 1.0, edges);
  for (const ProjectedEdge& edge : edges)
  {
    PixelSegment segment{ edge.A - origin, edge.B - origin };
    if (ClipToPixel(segment))
    {
      segments.push_back(segment);
    }
  }
}

}
