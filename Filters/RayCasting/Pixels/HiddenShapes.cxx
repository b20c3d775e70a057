// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "HiddenShapes.h"

#include "CoverageConstants.h"
#include "Scene.h"
#include "TriangleIntersection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

double MaximumOpaqueDepth(const Scene& scene, const Sample& sample, glm::dvec2 origin)
{
  if (!(sample.OpaqueDepth < std::numeric_limits<float>::infinity()))
  {
    return std::numeric_limits<double>::infinity();
  }
  if (sample.OpaqueDepth != sample.FirstHit.Distance)
  {
    return sample.OpaqueDepth +
      scene.ViewCamera.DepthOfRayOrigins(); // behind something translucent
  }
  return MaximumDepthInPixel(scene, { sample.FirstHit.Surface, sample.FirstHit.Primitive }, origin);
}

double ComputeDepthBehind(double depth, const Camera& camera)
{
  return depth + RelativeDepthTolerance * std::abs(depth - camera.DepthOfRayOrigins());
}

HiddenShapes::HiddenShapes(
  const Scene& scene, const CornerGrid& grid, glm::ivec2 low, glm::ivec2 high)
  : Low(low),
    High(high)
{
  const std::size_t pixels = static_cast<std::size_t>(high.x - low.x) * (high.y - low.y);
  this->OpaqueDepths.assign(pixels, std::numeric_limits<double>::infinity());
  this->NearestDepths.assign(pixels, std::numeric_limits<double>::infinity());
  const glm::ivec2 first = glm::max(low, grid.GetLow());
  const glm::ivec2 last = glm::min(high, grid.GetHigh());
  for (int y = first.y; y < last.y; ++y)
  {
    for (int x = first.x; x < last.x; ++x)
    {
      double depth = 0.0;
      for (int i = 0; i < 4; ++i)
      {
        const Sample corner = grid.At(x + (i & 1), y + (i >> 1));
        depth = std::max(depth, MaximumOpaqueDepth(scene, corner, glm::dvec2(x, y)));
      }
      this->OpaqueDepths[this->Index({ x, y })] = ComputeDepthBehind(depth, scene.ViewCamera);
    }
  }
}

bool HiddenShapes::Add(const ShapeBounds& bounds)
{
  if (!bounds.IsVisible || !bounds.IsKnown)
  {
    return false;
  }
  const glm::ivec2 first(
    glm::max(glm::floor(bounds.Low - 2.0 * EdgeMargin), glm::dvec2(this->Low)));
  const glm::ivec2 last(
    glm::min(glm::floor(bounds.High + 2.0 * EdgeMargin), glm::dvec2(this->High - 1)));
  for (int y = first.y; y <= last.y; ++y)
  {
    for (int x = first.x; x <= last.x; ++x)
    {
      if (!(bounds.Depth > this->OpaqueDepths[this->Index({ x, y })]))
      {
        return false;
      }
    }
  }
  for (int y = first.y; y <= last.y; ++y)
  {
    for (int x = first.x; x <= last.x; ++x)
    {
      double& nearest = this->NearestDepths[this->Index({ x, y })];
      nearest = std::min(nearest, bounds.Depth);
    }
  }
  return first.x <= last.x && first.y <= last.y;
}

}
