// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleIntersection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

namespace
{

double Cross(glm::dvec2 a, glm::dvec2 b)
{
  return a.x * b.y - a.y * b.x;
}

/// A triangle in pixel coordinates with the quantity that is linear there: 1/depth in perspective,
/// depth in parallel projection.
struct SeenTriangle
{
  glm::dvec2 Corners[3];
  double Turn; ///< twice the signed area
  glm::dvec2 Slope;
  double AtOrigin;
};

bool See(const Scene& scene, TriangleId id, glm::dvec2 origin, SeenTriangle& seen)
{
  const Surface& surface = scene.Surfaces[id.Surface];
  const glm::uvec3 triangle = surface.Triangles[id.Triangle];
  double linear[3];
  for (int i = 0; i < 3; ++i)
  {
    const glm::dvec3 p(surface.Positions[triangle[i]]);
    const double depth = scene.ViewCamera.Depth(p);
    if (!scene.ViewCamera.Parallel && depth <= scene.ViewCamera.Near)
    {
      return false;
    }
    seen.Corners[i] = scene.ViewCamera.Project(p) - origin;
    linear[i] = scene.ViewCamera.Parallel ? depth : 1.0 / depth;
  }
  const glm::dvec2 d = seen.Corners[1] - seen.Corners[0];
  const glm::dvec2 e = seen.Corners[2] - seen.Corners[0];
  seen.Turn = Cross(d, e);
  if (std::abs(seen.Turn) < 1e-9)
  {
    return false; // seen edge-on
  }
  const double u = linear[1] - linear[0];
  const double v = linear[2] - linear[0];
  seen.Slope = glm::dvec2(u * e.y - v * d.y, v * d.x - u * e.x) / seen.Turn;
  seen.AtOrigin = linear[0] - glm::dot(seen.Slope, seen.Corners[0]);
  return true;
}

/// Narrows [enter, leave] to the part of p + t d inside the triangle.
void ClipToTriangle(
  const SeenTriangle& triangle, glm::dvec2 p, glm::dvec2 d, double& enter, double& leave)
{
  for (int i = 0; i < 3; ++i)
  {
    const glm::dvec2 corner = triangle.Corners[i];
    const glm::dvec2 side = triangle.Corners[(i + 1) % 3] - corner;
    const double sign = triangle.Turn > 0.0 ? 1.0 : -1.0;
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

}

bool ShareAnEdge(const Scene& scene, TriangleId a, TriangleId b)
{
  const Surface& s = scene.Surfaces[a.Surface];
  const Surface& t = scene.Surfaces[b.Surface];
  int shared = 0;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      shared += s.Positions[s.Triangles[a.Triangle][i]] == t.Positions[t.Triangles[b.Triangle][j]];
    }
  }
  return shared >= 2;
}

double MaximumDepthInPixel(const Scene& scene, TriangleId id, glm::dvec2 origin)
{
  SeenTriangle seen;
  if (!See(scene, id, origin, seen))
  {
    return std::numeric_limits<double>::infinity();
  }
  const glm::dvec2 low = glm::min(seen.Slope, 0.0);
  const glm::dvec2 high = glm::max(seen.Slope, 0.0);
  if (scene.ViewCamera.Parallel)
  {
    return seen.AtOrigin + high.x + high.y;
  }
  const double least = seen.AtOrigin + low.x + low.y;
  return least > 0.0 ? 1.0 / least : std::numeric_limits<double>::infinity();
}

bool IntersectTriangles(
  const Scene& scene, TriangleId a, TriangleId b, glm::dvec2 origin, PixelSegment& segment)
{
  SeenTriangle s;
  SeenTriangle t;
  if (ShareAnEdge(scene, a, b) || !See(scene, a, origin, s) || !See(scene, b, origin, t))
  {
    return false;
  }
  const glm::dvec2 slope = s.Slope - t.Slope;
  const double square = glm::dot(slope, slope);
  const double level = s.AtOrigin - t.AtOrigin;
  if (!(square > 1e-24 * (glm::dot(s.Slope, s.Slope) + glm::dot(t.Slope, t.Slope))))
  {
    return false; // parallel
  }
  const glm::dvec2 foot = -slope * (level / square);
  const glm::dvec2 direction = glm::dvec2(-slope.y, slope.x) / std::sqrt(square);
  const double along = glm::dot(glm::dvec2(0.5) - foot, direction);
  const glm::dvec2 middle = foot + along * direction;
  double enter = -1.0;
  double leave = 1.0;
  ClipToTriangle(s, middle, direction, enter, leave);
  ClipToTriangle(t, middle, direction, enter, leave);
  if (!(leave - enter > 1e-6))
  {
    return false;
  }
  segment = { middle + enter * direction, middle + leave * direction };
  return ClipToPixel(segment);
}

}
