// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Visibility from the camera of points above a surface point.

// Returns an orthonormal frame whose third axis is the normal.
mat3 tangentFrame(vec3 normal)
{
  vec3 axis = abs(normal.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
  vec3 tangent = normalize(cross(axis, normal));
  return mat3(tangent, cross(normal, tangent), normal);
}

// Returns the distance along the view axis of the tangent plane at a position in the image, in
// pixels.
float tangentDepth(SurfacePoint point, vec2 pixel)
{
  vec2 plane = planeOfPixel(pixel);
  float inPerspective = dot(point.normal, point.position) / dot(point.normal, vec3(plane, -1.0));
  float inParallel =
    dot(point.normal.xy, plane - point.position.xy) / point.normal.z - point.position.z;
  return perspective > 0.5 ? inPerspective : inParallel;
}

// Returns the distance of a point behind the visible surface at its pixel, in radii; negative if
// the point is visible. The point is moved to the pixel center parallel to the tangent plane. Its
// height over the plane does not change, so that an open plane blocks no points.
float depthBehind(SurfacePoint point, vec3 position)
{
  vec2 exact = pixelOfPosition(position);
  vec2 center = floor(exact) + 0.5;
  float shift = tangentDepth(point, center) - tangentDepth(point, exact);
  return -position.z + shift - eyeDepthAt(center);
}
