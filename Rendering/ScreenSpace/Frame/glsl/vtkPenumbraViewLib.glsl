// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// From pixels to eye coordinates and back. Lengths are in units of the occlusion radius (of
// whatever unit the view was given), the eye looks along -z, pixels have their centres at
// half-integers.
uniform vec4 pixelToEye;   // xy * pixel + zw is (x, y) on the plane at distance 1 (parallel: anywhere)
uniform vec2 depthToEye;   // x + y * (1 - depth of the depth buffer): distance, or its inverse
uniform float perspective; // 1, or 0 under a parallel camera
uniform vec2 pixelSize;    // 1 / size of the picture

// Farther than anything: what empty pixels hold.
const float farAway = 1e18;

float eyeDepthOfBuffer(float depth)
{
  float q = depthToEye.x + depthToEye.y * (1.0 - depth);
  float distance = perspective > 0.5 ? 1.0 / q : q;
  return depth < 1.0 ? distance : farAway;
}

vec3 eyePosition(vec2 pixel, float eyeDepth)
{
  vec2 plane = pixelToEye.xy * pixel + pixelToEye.zw;
  return vec3(plane * mix(1.0, eyeDepth, perspective), -eyeDepth);
}

vec2 pixelOfPosition(vec3 position)
{
  vec2 plane = position.xy / mix(1.0, -position.z, perspective);
  return (plane - pixelToEye.zw) / pixelToEye.xy;
}

// Unit vector from a position to the eye.
vec3 towardsEye(vec3 position)
{
  return perspective > 0.5 ? normalize(-position) : vec3(0.0, 0.0, 1.0);
}
