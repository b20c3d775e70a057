// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LineExpansion.h"

namespace penumbra
{
namespace
{

/// Returns the side length of a pixel at the depth of x, in scene units.
double ComputePixelSize(const Camera& camera, glm::dvec3 x)
{
  return camera.Parallel ? camera.PixelSize : camera.PixelSize * camera.Depth(x);
}

/// Moves x toward the camera by `pixels` times the pixel size at x. Its image coordinates do not
/// change.
glm::dvec3 OffsetTowardEye(const Camera& camera, glm::dvec3 x, double pixels)
{
  if (camera.Parallel)
  {
    return x - pixels * camera.PixelSize * camera.Forward;
  }
  // Move x at most half the distance to the camera, so that wide lines stay in front of the camera.
  const double fraction = glm::min(pixels * camera.PixelSize, 0.5);
  return x - fraction * (x - camera.Position);
}

}

bool ExpandLine(const Camera& camera, glm::dvec3 a, glm::dvec3 b, double width, Quad& quad)
{
  const double fromDepth = camera.Depth(a) - camera.Near;
  const double toDepth = camera.Depth(b) - camera.Near;
  if (fromDepth <= 0.0 && toDepth <= 0.0)
  {
    return false;
  }
  quad.Start = fromDepth < 0.0 ? fromDepth / (fromDepth - toDepth) : 0.0;
  quad.End = toDepth < 0.0 ? fromDepth / (fromDepth - toDepth) : 1.0;
  const glm::dvec3 start = glm::mix(a, b, quad.Start);
  const glm::dvec3 end = glm::mix(a, b, quad.End);
  const glm::dvec2 delta = camera.Project(end) - camera.Project(start);
  const double length = glm::length(delta);
  if (!(length > 1e-9))
  {
    return false;
  }
  const glm::dvec3 normal = (-delta.y / length) * camera.Right + (delta.x / length) * camera.Up;
  const glm::dvec3 startOffset = 0.5 * width * ComputePixelSize(camera, start) * normal;
  const glm::dvec3 endOffset = 0.5 * width * ComputePixelSize(camera, end) * normal;
  quad.Corners[0] = OffsetTowardEye(camera, start - startOffset, width);
  quad.Corners[1] = OffsetTowardEye(camera, end - endOffset, width);
  quad.Corners[2] = OffsetTowardEye(camera, end + endOffset, width);
  quad.Corners[3] = OffsetTowardEye(camera, start + startOffset, width);
  return true;
}

bool ExpandPoint(const Camera& camera, glm::dvec3 x, double size, double offset, Quad& quad)
{
  if (camera.Depth(x) <= camera.Near)
  {
    return false;
  }
  const double half = 0.5 * size * ComputePixelSize(camera, x);
  const glm::dvec3 right = half * camera.Right;
  const glm::dvec3 up = half * camera.Up;
  quad.Corners[0] = OffsetTowardEye(camera, x - right - up, offset);
  quad.Corners[1] = OffsetTowardEye(camera, x + right - up, offset);
  quad.Corners[2] = OffsetTowardEye(camera, x + right + up, offset);
  quad.Corners[3] = OffsetTowardEye(camera, x - right + up, offset);
  return true;
}

}
