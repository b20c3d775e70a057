// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LineExpansion.h"

#include <algorithm>

namespace penumbra
{
namespace
{

/// Moves x toward the camera by `pixels` times the pixel size at x. Its image coordinates do not
/// change.
glm::dvec3 OffsetTowardEye(const Camera& camera, glm::dvec3 x, double pixels)
{
  if (camera.Parallel)
  {
    return x - pixels * camera.PixelSize * camera.Forward;
  }
  // Move x at most half the distance to the camera, so that wide lines stay in front of the camera.
  const double fraction = glm::clamp(pixels * camera.PixelSize, -1.0, 0.5);
  return x - fraction * (x - camera.Position);
}

/// Returns the number of pixels by which a line or point of the given slope moves toward the camera.
double ChooseShift(const Camera& camera, glm::dvec3 x, const QuadShift& shift, double slope)
{
  const double offset = shift.Offset.IsZero()
    ? 0.0
    : ComputeShift(camera, x, shift.Offset, std::max(slope, shift.Slope));
  return offset < 0.0 ? offset : std::max(shift.Pixels, offset);
}

}

bool ExpandLine(const Camera& camera, glm::dvec3 a, glm::dvec3 b, double width,
  const QuadShift& shift, Quad& quad)
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
  const double slope = shift.Offset.IsZero() ? 0.0 : ComputeSlope(camera, start, end);
  const double startShift = ChooseShift(camera, start, shift, slope);
  const double endShift = ChooseShift(camera, end, shift, slope);
  quad.Corners[0] = OffsetTowardEye(camera, start - startOffset, startShift);
  quad.Corners[1] = OffsetTowardEye(camera, end - endOffset, endShift);
  quad.Corners[2] = OffsetTowardEye(camera, end + endOffset, endShift);
  quad.Corners[3] = OffsetTowardEye(camera, start + startOffset, startShift);
  return true;
}

bool ExpandPoint(
  const Camera& camera, glm::dvec3 x, double size, const QuadShift& shift, Quad& quad)
{
  if (camera.Depth(x) <= camera.Near)
  {
    return false;
  }
  const double half = 0.5 * size * ComputePixelSize(camera, x);
  const glm::dvec3 right = half * camera.Right;
  const glm::dvec3 up = half * camera.Up;
  const double pixels = ChooseShift(camera, x, shift, 0.0);
  quad.Corners[0] = OffsetTowardEye(camera, x - right - up, pixels);
  quad.Corners[1] = OffsetTowardEye(camera, x + right - up, pixels);
  quad.Corners[2] = OffsetTowardEye(camera, x + right + up, pixels);
  quad.Corners[3] = OffsetTowardEye(camera, x - right + up, pixels);
  return true;
}

}
