// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SubpixelTriangles.h"

#include "EdgeConstants.h"
#include "Surface.h"
#include "Tiles/ScreenTriangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

bool HasSubpixelTriangles(const Surface& surface, const Camera& camera)
{
  const std::size_t count = surface.IsRound() ? 0 : surface.GetNumberOfPrimitives();
  const std::size_t stride = count / MaximumTrianglesSampled + 1;
  const glm::dvec2 size(camera.Width, camera.Height);
  glm::dvec2 minimum = size;
  glm::dvec2 maximum(0.0);
  double area = 0.0;
  double visible = 0.0;
  for (std::size_t t = 0; t < count; t += stride)
  {
    const ScreenTriangle triangle(surface.GetPoints(static_cast<std::uint32_t>(t)), camera);
    if (!triangle.IsWhole())
    {
      continue;
    }
    const auto& p = triangle.Points;
    const glm::dvec2 low = glm::min(glm::min(p[0], p[1]), p[2]);
    const glm::dvec2 high = glm::max(glm::max(p[0], p[1]), p[2]);
    if (high.x < 0.0 || high.y < 0.0 || low.x > size.x || low.y > size.y)
    {
      continue;
    }
    minimum = glm::max(glm::min(minimum, low), 0.0);
    maximum = glm::min(glm::max(maximum, high), size);
    area += 0.5 * std::abs(triangle.ComputeDoubleArea());
    visible += 1.0;
  }
  // Small triangles that are sparse in the image are small objects, which are covered exactly.
  const glm::dvec2 extent = glm::max(maximum - minimum, 1.0);
  return visible > 0.0 && area < SubpixelArea * visible &&
    visible * static_cast<double>(stride) >
    TrianglesPerPixel * extent.x * extent.y + MinimumTriangles;
}

}
