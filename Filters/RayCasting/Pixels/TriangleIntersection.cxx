// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleIntersection.h"

#include "Edges/RoundOutlines.h"
#include "Embree/RoundIntersection.h"
#include "Scene.h"
#include "Surface.h"
#include "Tiles/ScreenTriangle.h"
#include "Vectors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace penumbra
{

namespace
{

/// Triangles with a smaller area, doubled, in pixels are seen edge-on.
constexpr double MinimumDoubleArea = 1e-9;

/// A point of the axis of a tube, the radius there, and its distance from a line.
struct AxisPoint
{
  glm::dvec3 Position;
  double Radius;
  double Distance;
};

/// Returns the point of the axis that is nearest to a line.
AxisPoint FindNearestOnAxis(const RoundShape& tube, glm::dvec3 origin, glm::dvec3 direction)
{
  const glm::dvec3 a(tube.A);
  const glm::dvec3 axis = glm::dvec3(tube.B) - a;
  // Components perpendicular to the line.
  const auto reject = [&](const glm::dvec3& v) {
    return v - glm::dot(v, direction) / glm::dot(direction, direction) * direction;
  };
  const glm::dvec3 across = reject(axis);
  const double square = glm::dot(across, across);
  const double u =
    square > 0.0 ? glm::clamp(-glm::dot(reject(a - origin), across) / square, 0.0, 1.0) : 0.0;
  return { a + u * axis, glm::mix<double>(tube.RadiusA, tube.RadiusB, u),
    glm::length(reject(a + u * axis - origin)) };
}

/// The axis of a tube next to a pixel, and the size of the pixel there.
struct PixelTube
{
  AxisPoint Nearest;
  double Footprint;

  PixelTube(const RoundShape& tube, const Camera& camera, glm::dvec2 origin)
    : Nearest(
        FindNearestOnAxis(tube, camera.RayOrigin(origin + 0.5), camera.RayDirection(origin + 0.5))),
      Footprint(camera.PixelSize *
        (camera.Parallel ? 1.0 : std::max(camera.Depth(this->Nearest.Position), 0.0)))
  {
  }
};

/// Returns true if the tubes of one surface belong to one polyline and are so close along it that
/// their overlap is the joint.
bool AreJoined(const Surface& surface, std::uint32_t a, std::uint32_t b)
{
  const std::uint32_t last = std::max(a, b);
  double length = 0.0;
  double limit = 0.0;
  for (std::uint32_t i = std::min(a, b); i < last && length <= limit; ++i)
  {
    if (surface.Segments[i].y != surface.Segments[i + 1].x)
    {
      return false;
    }
    const RoundShape shape = surface.GetRoundShape(i);
    limit = std::max(limit, 4.0 * std::max(shape.RadiusA, shape.RadiusB));
    length += i == std::min(a, b) ? 0.0 : glm::distance(shape.A, shape.B);
  }
  return length <= limit;
}

/// A triangle relative to the lower left corner of a pixel, with the plane of its keys.
struct PixelTriangle
{
  ScreenTriangle Projected;
  double DoubleArea = 0.0;
  glm::dvec2 Gradient{ 0.0 };
  double ValueAtOrigin = 0.0;
  bool IsUsable = false; ///< false if the near plane cuts the triangle, or it is seen edge-on

  PixelTriangle(const Scene& scene, PrimitiveId id, glm::dvec2 origin)
    : Projected(scene.Surfaces[id.Surface].GetPoints(id.Primitive), scene.ViewCamera)
  {
    if (!this->Projected.IsWhole())
    {
      return;
    }
    this->Projected.MoveOrigin(origin);
    this->DoubleArea = this->Projected.ComputeDoubleArea();
    this->IsUsable = !(std::abs(this->DoubleArea) < MinimumDoubleArea);
    if (this->IsUsable)
    {
      const LinearValue<double> keys = this->Projected.MakeKeyPlane();
      this->Gradient = glm::dvec2(keys.SlopeX, keys.SlopeY);
      this->ValueAtOrigin = keys.Value;
    }
  }
};

/// Narrows [enter, leave] to the range of t for which p + t * d is inside the triangle.
void ClipToTriangle(
  const PixelTriangle& triangle, glm::dvec2 p, glm::dvec2 d, double& enter, double& leave)
{
  for (int i = 0; i < 3; ++i)
  {
    const glm::dvec2 corner = triangle.Projected.Points[i];
    const glm::dvec2 side = triangle.Projected.Points[(i + 1) % 3] - corner;
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

bool HaveCommonEdge(const std::vector<Surface>& surfaces, PrimitiveId a, PrimitiveId b)
{
  const Surface& s = surfaces[a.Surface];
  const Surface& t = surfaces[b.Surface];
  if (s.IsRound() || t.IsRound())
  {
    return false;
  }
  const std::array<glm::vec3, 3> p = s.GetPoints(a.Primitive);
  const std::array<glm::vec3, 3> q = t.GetPoints(b.Primitive);
  int shared = 0;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      shared += p[i] == q[j];
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
  const PixelTriangle triangle(scene, id, origin);
  if (!triangle.IsUsable)
  {
    return std::numeric_limits<double>::infinity();
  }
  const glm::dvec2 low = glm::min(triangle.Gradient, 0.0);
  const double minimum = triangle.ValueAtOrigin + low.x + low.y;
  if (scene.ViewCamera.Parallel)
  {
    return -minimum;
  }
  return minimum > 0.0 ? 1.0 / minimum : std::numeric_limits<double>::infinity();
}

bool IntersectTriangles(
  const Scene& scene, PrimitiveId a, PrimitiveId b, glm::dvec2 origin, PixelSegment& segment)
{
  if (HaveCommonEdge(scene.Surfaces, a, b))
  {
    return false;
  }
  const PixelTriangle s(scene, a, origin);
  const PixelTriangle t(scene, b, origin);
  if (!s.IsUsable || !t.IsUsable)
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
    const std::array<glm::vec3, 3> points = other.GetPoints(b.Primitive);
    const glm::dvec3 p(points[0]);
    const glm::dvec3 n = glm::cross(glm::dvec3(points[1]) - p, glm::dvec3(points[2]) - p);
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

bool IsTubeInPixel(const Scene& scene, PrimitiveId id, glm::dvec2 origin)
{
  const RoundShape tube = scene.Surfaces[id.Surface].GetRoundShape(id.Primitive);
  const PixelTube inPixel(tube, scene.ViewCamera, origin);
  return inPixel.Nearest.Distance <= inPixel.Nearest.Radius + inPixel.Footprint;
}

bool MayIntersectTube(const Scene& scene, PrimitiveId a, PrimitiveId b, glm::dvec2 origin)
{
  const auto isTube = [&](PrimitiveId id) {
    const Surface& surface = scene.Surfaces[id.Surface];
    return surface.IsRound() && !surface.Segments.empty();
  };
  if (!isTube(a))
  {
    std::swap(a, b);
  }
  if (!isTube(a) || !IsTubeInPixel(scene, a, origin))
  {
    return false;
  }
  const RoundShape tube = scene.Surfaces[a.Surface].GetRoundShape(a.Primitive);
  const PixelTube inPixel(tube, scene.ViewCamera, origin);
  const AxisPoint& point = inPixel.Nearest;
  const double footprint = inPixel.Footprint;
  const Surface& other = scene.Surfaces[b.Surface];
  if (other.IsRound())
  {
    if (a.Surface == b.Surface && AreJoined(other, a.Primitive, b.Primitive))
    {
      return false;
    }
    const RoundShape shape = other.GetRoundShape(b.Primitive);
    const bool joined = !shape.HasFlatEnds && !tube.HasFlatEnds &&
      (shape.A == tube.A || shape.A == tube.B || shape.B == tube.A || shape.B == tube.B);
    const double reach = point.Radius + std::max(shape.RadiusA, shape.RadiusB) + footprint;
    const glm::dvec3 d(shape.B - shape.A);
    const double square = glm::dot(d, d);
    const glm::dvec3 offset = point.Position - glm::dvec3(shape.A);
    const double u = square > 0.0 ? glm::clamp(glm::dot(offset, d) / square, 0.0, 1.0) : 0.0;
    return !joined && glm::length(offset - u * d) < reach;
  }
  const std::array<glm::vec3, 3> points = other.GetPoints(b.Primitive);
  const glm::dvec3 p(points[0]);
  const glm::dvec3 normal = glm::cross(glm::dvec3(points[1]) - p, glm::dvec3(points[2]) - p);
  const double length = glm::length(normal);
  return length > 0.0 &&
    std::abs(glm::dot(point.Position - p, normal)) < length * (point.Radius + footprint);
}

}
