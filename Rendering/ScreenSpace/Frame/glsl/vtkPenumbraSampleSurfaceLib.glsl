// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Which pixel shows the surface of a sample. Needs ViewLib.
uniform sampler2D eyeDepths;

// Relative rounding error of depths.
const float depthPrecision = 1e-4;

// Returns the change in depth of the surface of a pixel over the distance of two pixels: the smaller
// difference to the neighbors on both sides, in x and y. It is at most a tenth of the depth:
// a tip of one pixel has other surfaces on both sides.
float depthSlope(vec2 pixel)
{
  float depth = texture(eyeDepths, pixel * pixelSize).r;
  float slope = 0.0;
  for (int axis = 0; axis < 2; ++axis)
  {
    vec2 direction = axis == 0 ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
    float ahead = abs(texture(eyeDepths, (pixel + direction) * pixelSize).r - depth);
    float behind = abs(texture(eyeDepths, (pixel - direction) * pixelSize).r - depth);
    slope += min(ahead, behind);
  }
  return min(slope, 0.1 * depth);
}

// Returns the texture coordinates of the pixel or, if the eye depth of the sample differs by more
// than `slope` and thus belongs to another surface, of the 3 x 3 pixel closest in depth; z is the
// difference of the depths.
vec3 positionOfSurface(float sampleDepth, vec2 pixel, float slope)
{
  vec2 position = pixel * pixelSize;
  float nearest = abs(texture(eyeDepths, position).r - sampleDepth);
  int count = nearest > slope + depthPrecision * sampleDepth ? 9 : 0;
  for (int i = 0; i < count; ++i)
  {
    vec2 neighbor = (pixel + vec2(float(i % 3 - 1), float(i / 3 - 1))) * pixelSize;
    float difference = abs(texture(eyeDepths, neighbor).r - sampleDepth);
    position = difference < nearest ? neighbor : position;
    nearest = min(difference, nearest);
  }
  return vec3(position, nearest);
}
