// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Position and normal of the visible surface at a pixel, reconstructed from eye depths.
uniform sampler2D eyeDepths;

struct SurfacePoint
{
  vec2 pixel;
  vec3 position;
  vec3 normal; // unit, toward the camera
};

float eyeDepthAt(vec2 pixel)
{
  return texture(eyeDepths, pixel * pixelSize).r;
}

// Returns the position visible at the center of the pixel that contains a point of the image.
vec3 eyePositionAt(vec2 pixel)
{
  return eyePosition(floor(pixel) + 0.5, eyeDepthAt(pixel));
}

// Returns the one-sided difference with the smaller change in depth, which most likely lies on the
// surface of the point. If both neighbors are empty, returns the offset to the pixel ahead at the
// depth of the point.
vec3 minDiff(vec3 ahead, vec3 behind, vec3 position, vec2 pixelAhead)
{
  vec3 nearer = abs(ahead.z) < abs(behind.z) ? ahead : behind;
  vec3 across = eyePosition(pixelAhead, -position.z) - position;
  return abs(nearer.z) < 0.5 * farAway ? nearer : across;
}

vec3 minDiffNeighbor(vec3 position, vec2 pixel, vec2 direction)
{
  vec3 ahead = eyePositionAt(pixel + direction) - position;
  vec3 behind = position - eyePositionAt(pixel - direction);
  return minDiff(ahead, behind, position, pixel + direction);
}

SurfacePoint surfaceAt(vec2 pixel)
{
  SurfacePoint point;
  point.pixel = pixel;
  point.position = eyePositionAt(pixel);
  vec3 right = minDiffNeighbor(point.position, pixel, vec2(1.0, 0.0));
  vec3 up = minDiffNeighbor(point.position, pixel, vec2(0.0, 1.0));
  point.normal = normalize(cross(right, up));
  return point;
}
