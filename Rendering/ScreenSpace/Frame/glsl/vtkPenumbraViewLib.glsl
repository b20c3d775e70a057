// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Transforms between pixels and eye coordinates. Lengths are in the unit of the view (the radius
// for ambient occlusion), the eye looks along -z, and pixel centers are at half-integers.
uniform vec4 pixelToEye;   // xy * pixel + zw is (x, y) on the plane at depth 1 (parallel: at any depth)
uniform float pixelSkew;   // times y of a pixel is added to x on that plane
uniform vec2 depthToEye;   // x + y * (1 - depth buffer value): eye depth (parallel) or its inverse
uniform float perspective; // 1, or 0 under a parallel camera
uniform vec2 pixelSize;    // 1 / size of the image

// Eye depth of empty pixels.
const float farAway = 1e18;

float eyeDepthOfBuffer(float depth)
{
  float q = depthToEye.x + depthToEye.y * (1.0 - depth);
  float distance = perspective > 0.5 ? 1.0 / q : q;
  return depth < 1.0 ? distance : farAway;
}

// Returns (x, y) of a pixel on the plane at depth 1 (parallel: at any depth).
vec2 planeOfPixel(vec2 pixel)
{
  return pixelToEye.xy * pixel + pixelToEye.zw + vec2(pixelSkew * pixel.y, 0.0);
}

// Returns the offset in pixels of an offset on that plane.
vec2 pixelOffsetOnPlane(vec2 offset)
{
  float y = offset.y / pixelToEye.y;
  return vec2((offset.x - pixelSkew * y) / pixelToEye.x, y);
}

vec3 eyePosition(vec2 pixel, float eyeDepth)
{
  vec2 plane = planeOfPixel(pixel);
  return vec3(plane * mix(1.0, eyeDepth, perspective), -eyeDepth);
}

vec2 pixelOfPosition(vec3 position)
{
  vec2 plane = position.xy / mix(1.0, -position.z, perspective);
  return pixelOffsetOnPlane(plane - pixelToEye.zw);
}

// Unit vector from a position toward the eye.
vec3 towardEye(vec3 position)
{
  return perspective > 0.5 ? normalize(-position) : vec3(0.0, 0.0, 1.0);
}
