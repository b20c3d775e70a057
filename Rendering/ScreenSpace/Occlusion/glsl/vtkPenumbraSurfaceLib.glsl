// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The visible surface at a pixel, from eye depths alone.
uniform sampler2D eyeDepths;

struct SurfacePoint
{
  vec2 pixel;
  vec3 position;
  vec3 normal; // unit, towards the eye
};

float eyeDepthAt(vec2 pixel)
{
  return texture(eyeDepths, pixel * pixelSize).r;
}

// What the pixel that holds a point of the picture sees at its centre.
vec3 eyePositionAt(vec2 pixel)
{
  return eyePosition(floor(pixel) + 0.5, eyeDepthAt(pixel));
}

// Of the ways to and from two neighbours, that of the one which lies on the same surface, as far as depths
// tell. Where neither shows a surface: across the view, to the pixel ahead.
vec3 nearerOf(vec3 ahead, vec3 behind, vec3 position, vec2 pixelAhead)
{
  vec3 nearer = abs(ahead.z) < abs(behind.z) ? ahead : behind;
  vec3 across = eyePosition(pixelAhead, -position.z) - position;
  return abs(nearer.z) < 0.5 * farAway ? nearer : across;
}

vec3 nearerNeighbour(vec3 position, vec2 pixel, vec2 way)
{
  vec3 ahead = eyePositionAt(pixel + way) - position;
  vec3 behind = position - eyePositionAt(pixel - way);
  return nearerOf(ahead, behind, position, pixel + way);
}

SurfacePoint surfaceAt(vec2 pixel)
{
  SurfacePoint point;
  point.pixel = pixel;
  point.position = eyePositionAt(pixel);
  vec3 right = nearerNeighbour(point.position, pixel, vec2(1.0, 0.0));
  vec3 up = nearerNeighbour(point.position, pixel, vec2(0.0, 1.0));
  point.normal = normalize(cross(right, up));
  return point;
}
