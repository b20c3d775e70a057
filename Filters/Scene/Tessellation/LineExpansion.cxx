// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LineExpansion.h"

namespace penumbra
{
namespace
{

/// Side of a pixel at x.
double PixelAt(const Camera& eye, glm::dvec3 x)
{
  return eye.Parallel ? eye.PixelSize : eye.PixelSize * eye.Depth(x);
}

/// Moves x towards the eye by `pixels` times the size of a pixel there; its picture stays.
glm::dvec3 OffsetTowardEye(const Camera& eye, glm::dvec3 x, double pixels)
{
  if (eye.Parallel)
  {
    return x - pixels * eye.PixelSize * eye.Forward;
  }
  // Never past the middle between the eye and x, however wide the line.
  const double share = glm::min(pixels * eye.PixelSize, .5);
  return x - share * (x - eye.Position);
}

}

bool ExpandLine(const Camera& eye, glm::dvec3 a, glm::dvec3 b, double width, Quad& quad)
{
  const double fromDepth = eye.Depth(a) - eye.Near;
  const double toDepth = eye.Depth(b) - eye.Near;
  if (fromDepth <= 0.0 && toDepth <= 0.0)
  {
    return false;
  }
  quad.Start = fromDepth < 0.0 ? fromDepth / (fromDepth - toDepth) : 0.0;
  quad.End = toDepth < 0.0 ? fromDepth / (fromDepth - toDepth) : 1.0;
  const glm::dvec3 start = glm::mix(a, b, quad.Start);
  const glm::dvec3 end = glm::mix(a, b, quad.End);
  const glm::dvec2 way = eye.Project(end) - eye.Project(start);
  const double length = glm::length(way);
  if (!(length > 1e-9))
  {
    return false;
  }
  const glm::dvec3 aside = (-way.y / length) * eye.Right + (way.x / length) * eye.Up;
  const glm::dvec3 atStart = .5 * width * PixelAt(eye, start) * aside;
  const glm::dvec3 atEnd = .5 * width * PixelAt(eye, end) * aside;
  quad.Corners[0] = OffsetTowardEye(eye, start - atStart, width);
  quad.Corners[1] = OffsetTowardEye(eye, end - atEnd, width);
  quad.Corners[2] = OffsetTowardEye(eye, end + atEnd, width);
  quad.Corners[3] = OffsetTowardEye(eye, start + atStart, width);
  return true;
}

bool ExpandPoint(const Camera& eye, glm::dvec3 x, double size, Quad& quad)
{
  if (eye.Depth(x) <= eye.Near)
  {
    return false;
  }
  const double half = .5 * size * PixelAt(eye, x);
  const glm::dvec3 right = half * eye.Right;
  const glm::dvec3 up = half * eye.Up;
  quad.Corners[0] = OffsetTowardEye(eye, x - right - up, size);
  quad.Corners[1] = OffsetTowardEye(eye, x + right - up, size);
  quad.Corners[2] = OffsetTowardEye(eye, x + right + up, size);
  quad.Corners[3] = OffsetTowardEye(eye, x - right + up, size);
  return true;
}

}
