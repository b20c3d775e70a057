// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// One of several samples of each pixel of the scene image. At an edge, the surface of a sample is
// that of a neighboring pixel, so that antialiased edges get no halos. Needs ViewLib.
uniform sampler2DMS colors;
uniform sampler2DMS depthSamples;
uniform sampler2D eyeDepths; // one per pixel
uniform int sampleIndex;

// Relative rounding error of depths.
const float depthPrecision = 1e-4;

vec4 sampleColor(vec2 pixel)
{
  return texelFetch(colors, ivec2(pixel), sampleIndex);
}

float sampleDepth(vec2 pixel)
{
  return texelFetch(depthSamples, ivec2(pixel), sampleIndex).r;
}

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

// Returns the texture coordinates of the pixel or, if the depth of the sample differs by more than
// the slope of its surface and thus belongs to another one, of the 3 x 3 pixel closest in depth; z
// is the difference of the eye depths.
vec3 surfacePosition(vec2 pixel, float depth)
{
  float eyeDepth = eyeDepthOfBuffer(depth);
  vec2 position = pixel * pixelSize;
  float nearest = abs(texture(eyeDepths, position).r - eyeDepth);
  if (nearest <= depthPrecision * eyeDepth || nearest <= depthSlope(pixel) + depthPrecision * eyeDepth)
  {
    return vec3(position, nearest);
  }
  for (int i = 0; i < 9; ++i)
  {
    vec2 neighbor = (pixel + vec2(float(i % 3 - 1), float(i / 3 - 1))) * pixelSize;
    float difference = abs(texture(eyeDepths, neighbor).r - eyeDepth);
    position = difference < nearest ? neighbor : position;
    nearest = min(difference, nearest);
  }
  return vec3(position, nearest);
}
