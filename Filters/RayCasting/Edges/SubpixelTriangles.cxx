// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SubpixelTriangles.h"

#include "EdgeConstants.h"
#include "Surface.h"
#include "Tiles/ScreenTriangle.h"

#include <cmath>

namespace penumbra
{

SubpixelTriangles::SubpixelTriangles(std::size_t count, const Camera& camera)
  : Minimum(camera.Width, camera.Height),
    Stride(count / MaximumTrianglesSampled + 1)
{
}

void SubpixelTriangles::Add(const Surface& part, std::size_t first, const Camera& camera)
{
  const std::size_t count = part.IsRound() ? 0 : part.GetNumberOfPrimitives();
  const glm::dvec2 size(camera.Width, camera.Height);
  for (std::size_t t = (this->Stride - first % this->Stride) % this->Stride; t < count;
       t += this->Stride)
  {
    const ScreenTriangle triangle(part.GetPoints(static_cast<std::uint32_t>(t)), camera);
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
    this->Minimum = glm::max(glm::min(this->Minimum, low), 0.0);
    this->Maximum = glm::min(glm::max(this->Maximum, high), size);
    this->Area += 0.5 * std::abs(triangle.ComputeDoubleArea());
    this->Visible += 1.0;
  }
}

bool SubpixelTriangles::AreDense() const
{
  // Small triangles that are sparse in the image are small objects, which are covered exactly.
  const glm::dvec2 extent = glm::max(this->Maximum - this->Minimum, 1.0);
  return this->Visible > 0.0 &&
    this->Area<SubpixelArea* this->Visible&& this->Visible* static_cast<double>(this->Stride)>
        TrianglesPerPixel *
      extent.x * extent.y +
    MinimumTriangles;
}

bool HasSubpixelTriangles(const Surface& surface, const Camera& camera)
{
  if (surface.Whole)
  {
    return surface.Whole->IsDense;
  }
  SubpixelTriangles triangles(surface.IsRound() ? 0 : surface.GetNumberOfPrimitives(), camera);
  triangles.Add(surface, 0, camera);
  return triangles.AreDense();
}

}
