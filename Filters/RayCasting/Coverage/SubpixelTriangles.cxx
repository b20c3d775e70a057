// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SubpixelTriangles.h"

#include "CoverageConstants.h"
#include "Execution/ParallelFor.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

namespace
{

/// Computes the corners of the triangle in the image. Returns false if a corner is behind the
/// camera.
bool ProjectTriangle(
  const Surface& surface, std::size_t triangle, const Camera& camera, glm::dvec2 (&corners)[3])
{
  for (int i = 0; i < 3; ++i)
  {
    const glm::dvec3 p(surface.Positions[surface.Triangles[triangle][i]]);
    if (!camera.Parallel && camera.Depth(p) <= 0.0)
    {
      return false;
    }
    corners[i] = camera.Project(p);
  }
  return true;
}

}

bool HasSubpixelTriangles(const Surface& surface, const Camera& camera)
{
  const std::size_t stride = surface.Triangles.size() / MaximumTrianglesSampled + 1;
  const glm::dvec2 size(camera.Width, camera.Height);
  glm::dvec2 minimum = size;
  glm::dvec2 maximum(0.0);
  double area = 0.0;
  double visible = 0.0;
  for (std::size_t t = 0; t < surface.Triangles.size(); t += stride)
  {
    glm::dvec2 p[3];
    if (!ProjectTriangle(surface, t, camera, p))
    {
      continue;
    }
    const glm::dvec2 low = glm::min(glm::min(p[0], p[1]), p[2]);
    const glm::dvec2 high = glm::max(glm::max(p[0], p[1]), p[2]);
    if (high.x < 0.0 || high.y < 0.0 || low.x > size.x || low.y > size.y)
    {
      continue;
    }
    minimum = glm::max(glm::min(minimum, low), 0.0);
    maximum = glm::min(glm::max(maximum, high), size);
    const glm::dvec2 d = p[1] - p[0];
    const glm::dvec2 e = p[2] - p[0];
    area += 0.5 * std::abs(d.x * e.y - d.y * e.x);
    visible += 1.0;
  }
  // Small triangles that are sparse in the image are small objects, which are covered exactly.
  const glm::dvec2 extent = glm::max(maximum - minimum, 1.0);
  return visible > 0.0 && area < SubpixelArea * visible &&
    visible * static_cast<double>(stride) >
    TrianglesPerPixel * extent.x * extent.y + MinimumTriangles;
}

namespace
{

/// Computes the pixels [first, last] within [low, high) that the projected bounds of `surface`
/// cover. All of them if the bounds extend behind the camera.
void BoundPixels(const Surface& surface, const Camera& camera, glm::ivec2 low, glm::ivec2 high,
  glm::ivec2& first, glm::ivec2& last)
{
  glm::vec3 minimum(std::numeric_limits<float>::max());
  glm::vec3 maximum(-std::numeric_limits<float>::max());
  for (const glm::vec3& p : surface.Positions)
  {
    minimum = glm::min(minimum, p);
    maximum = glm::max(maximum, p);
  }
  first = low;
  last = high - 1;
  glm::dvec2 from(high);
  glm::dvec2 to(low);
  for (int i = 0; i < 8; ++i)
  {
    const glm::dvec3 corner(
      i & 1 ? maximum.x : minimum.x, i & 2 ? maximum.y : minimum.y, i & 4 ? maximum.z : minimum.z);
    if (!camera.Parallel && camera.Depth(corner) <= 0.0)
    {
      return;
    }
    const glm::dvec2 p = camera.Project(corner);
    from = glm::min(from, p);
    to = glm::max(to, p);
  }
  first = glm::ivec2(glm::clamp(glm::floor(from), glm::dvec2(low), glm::dvec2(high)));
  last = glm::ivec2(glm::clamp(glm::floor(to), glm::dvec2(low) - 1.0, glm::dvec2(high - 1)));
}

}

void MarkCoveredPixels(const Surface& surface, const Camera& camera, glm::ivec2 low,
  glm::ivec2 high, std::vector<char>& pixels)
{
  const glm::ivec2 size = high - low;
  pixels.resize(static_cast<std::size_t>(size.x) * size.y, 0);
  glm::ivec2 first;
  glm::ivec2 final;
  BoundPixels(surface, camera, low, high, first, final);
  const glm::dvec2 bounded = glm::max(glm::dvec2(final - first) + 1.0, 0.0);
  if (static_cast<double>(surface.Triangles.size()) >
    TrianglesPerSampledPixel * bounded.x * bounded.y)
  {
    for (int y = first.y; y <= final.y; ++y)
    {
      char* row = pixels.data() + static_cast<std::size_t>(y - low.y) * size.x;
      std::fill(
        row + first.x - low.x, row + std::max(final.x - low.x + 1, first.x - low.x), char(1));
    }
    return;
  }
  // Project positions first, because each belongs to about six triangles.
  std::vector<glm::vec2> projected(surface.Positions.size());
  ParallelFor<std::size_t>(0, projected.size(), 0, [&](std::size_t i) {
    const glm::dvec3 p(surface.Positions[i]);
    const bool behind = !camera.Parallel && camera.Depth(p) <= 0.0;
    projected[i] = behind ? glm::vec2(std::numeric_limits<float>::quiet_NaN())
                          : glm::vec2(camera.Project(p) - glm::dvec2(low));
  });
  const glm::vec2 last(size - 1);
  for (const glm::uvec3& triangle : surface.Triangles)
  {
    const glm::vec2 a = projected[triangle.x];
    const glm::vec2 b = projected[triangle.y];
    const glm::vec2 c = projected[triangle.z];
    const glm::vec2 minimum = glm::floor(glm::min(glm::min(a, b), c) - ProjectionPrecision);
    const glm::vec2 maximum = glm::floor(glm::max(glm::max(a, b), c) + ProjectionPrecision);
    // Triangles behind the camera (NaN) are skipped. A triangle that crosses the camera plane is
    // much larger than a pixel, so corner rays hit it.
    if (!(maximum.x >= 0.f && maximum.y >= 0.f && minimum.x <= last.x && minimum.y <= last.y))
    {
      continue;
    }
    const glm::ivec2 from(glm::max(minimum, 0.f));
    const glm::ivec2 to(glm::min(maximum, last));
    for (int y = from.y; y <= to.y; ++y)
    {
      char* row = pixels.data() + static_cast<std::size_t>(y) * size.x;
      std::fill(row + from.x, row + to.x + 1, char(1));
    }
  }
}

}
