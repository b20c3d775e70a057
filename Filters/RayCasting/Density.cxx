// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Density.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

// Triangles looked at to judge a surface, and the mean area in pixels below which it is dense
// (measured: where exact coverage and 8 x 8 samples take the same time).
constexpr std::size_t TrianglesJudged = 100000;
constexpr double DenseArea = 1.0;

/// The triangle's corners in the picture; false when it reaches behind the eye.
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

bool IsDense(const Surface& surface, const Camera& camera)
{
  const std::size_t stride = surface.Triangles.size() / TrianglesJudged + 1;
  double area = 0.0;
  long long seen = 0;
  for (std::size_t t = 0; t < surface.Triangles.size(); t += stride)
  {
    glm::dvec2 p[3];
    if (!ProjectTriangle(surface, t, camera, p))
    {
      continue;
    }
    const glm::dvec2 low = glm::min(glm::min(p[0], p[1]), p[2]);
    const glm::dvec2 high = glm::max(glm::max(p[0], p[1]), p[2]);
    if (high.x < 0.0 || high.y < 0.0 || low.x > camera.Width || low.y > camera.Height)
    {
      continue;
    }
    const glm::dvec2 d = p[1] - p[0];
    const glm::dvec2 e = p[2] - p[0];
    area += 0.5 * std::abs(d.x * e.y - d.y * e.x);
    ++seen;
  }
  // A handful of small triangles is an object to be covered exactly, not a dense mesh.
  return seen * static_cast<long long>(stride) > 4096 &&
    area < DenseArea * static_cast<double>(seen);
}

void MarkPixels(const Surface& surface, const Camera& camera, glm::ivec2 low, glm::ivec2 high,
  std::vector<char>& pixels)
{
  const int width = high.x - low.x;
  pixels.resize(static_cast<std::size_t>(width) * (high.y - low.y), 0);
  for (std::size_t t = 0; t < surface.Triangles.size(); ++t)
  {
    glm::dvec2 p[3];
    if (!ProjectTriangle(surface, t, camera, p))
    {
      continue; // at the eye: much larger than a pixel, seen by the corners
    }
    const glm::dvec2 least = glm::min(glm::min(p[0], p[1]), p[2]) - glm::dvec2(low);
    const glm::dvec2 most = glm::max(glm::max(p[0], p[1]), p[2]) - glm::dvec2(low);
    const glm::ivec2 size = high - low;
    if (!(most.x >= 0.0 && most.y >= 0.0 && least.x < size.x && least.y < size.y))
    {
      continue;
    }
    const glm::ivec2 first = glm::max(glm::ivec2(glm::floor(glm::max(least, 0.0))), 0);
    const glm::ivec2 last =
      glm::min(glm::ivec2(glm::floor(glm::min(most, glm::dvec2(size)))), size - 1);
    for (int y = first.y; y <= last.y; ++y)
    {
      std::fill_n(pixels.begin() + static_cast<std::size_t>(y) * width + first.x,
        last.x - first.x + 1, char(1));
    }
  }
}

}
