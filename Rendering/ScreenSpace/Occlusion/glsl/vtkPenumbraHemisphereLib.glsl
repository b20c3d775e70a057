// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Points in space around a surface point, and whether the eye sees them.

// A frame whose third axis is the normal.
mat3 frameOf(vec3 normal)
{
  vec3 other = abs(normal.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
  vec3 tangent = normalize(cross(other, normal));
  return mat3(tangent, cross(normal, tangent), normal);
}

// Distance along the view axis of the tangent plane at a pixel's centre.
float tangentDepth(SurfacePoint point, vec2 pixel)
{
  vec2 plane = pixelToEye.xy * pixel + pixelToEye.zw;
  float inPerspective = dot(point.normal, point.position) / dot(point.normal, vec3(plane, -1.0));
  float inParallel =
    dot(point.normal.xy, plane - point.position.xy) / point.normal.z - point.position.z;
  return perspective > 0.5 ? inPerspective : inParallel;
}

// How far a point over the surface lies behind what the eye sees there, in radii; negative: it is
// seen. The point is moved to its pixel's centre along the tangent plane, so that its height over
// the plane stays and an open plane hides nothing.
float depthBehind(SurfacePoint point, vec3 position)
{
  vec2 exact = pixelOfPosition(position);
  vec2 center = floor(exact) + 0.5;
  float moved = tangentDepth(point, center) - tangentDepth(point, exact);
  return -position.z + moved - eyeDepthAt(center);
}
