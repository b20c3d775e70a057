// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The horizon kernel. A slice contains the camera and the point. The highest surface within the
// radius on each side of the slice is the horizon; directions below it are blocked. The
// cosine-weighted integral over a slice has a closed form [Jimenez et al. 2016, GTAO eq. 7]. The
// blocked part is summed instead of the open one, so that an open plane yields 0 in every slice,
// not only on average. Assumption: visible surfaces extend infinitely far back. D = 1 up to the
// radius.

const int stepsPerSide = 4; // a sample of the sequence is one slice of 2 * stepsPerSide fetches

// Integral of cos(t - n) |sin t| over a slice, for t from 0 (the view direction) to `angle`; n is
// the angle of the projected normal. The caller passes cos(2 angle - n), cos(n) and sin(n), which
// it computes from vectors without trigonometric functions.
float integrateArcCosWeight(
  float angle, float cosineOfTwice, float cosNormalAngle, float sinNormalAngle)
{
  return 0.25 * sign(angle) * (cosNormalAngle - cosineOfTwice + 2.0 * angle * sinNormalAngle);
}

// Returns cosine and sine of the angle between the projected normal and the horizon on one side of
// a slice. The sine is negative if the horizon lies beyond the normal. Heights are measured from
// the tangent plane, so that pixel centers off the line of the slice cause no error. `up` is the
// normal divided by its length projected into the slice, `tangent` the direction of this side in
// the tangent plane.
vec2 horizon(SurfacePoint point, vec3 up, vec3 tangent, vec2 step, float shift)
{
  vec2 highest = vec2(0.0, 1.0);
  for (int i = 0; i < stepsPerSide; ++i)
  {
    vec3 offset = eyePositionAt(point.pixel + step * (float(i) + shift)) - point.position;
    vec2 sampled = vec2(dot(offset, up), dot(offset, tangent));
    // All heights are positive, so that the angles can be compared without a division.
    bool higher = sampled.x > 0.0 && sampled.y * highest.x < highest.y * sampled.x;
    highest = dot(offset, offset) < 1.0 && higher ? sampled : highest;
  }
  return normalize(highest);
}

float signedAngle(vec2 direction)
{
  return sign(direction.y) * acos(direction.x);
}

float sliceOcclusion(SurfacePoint point, vec3 view, float azimuth, float shift)
{
  vec3 direction = vec3(cos(azimuth), sin(azimuth), 0.0);
  vec3 axis = normalize(cross(view, direction));
  vec3 projected = point.normal - axis * dot(point.normal, axis);
  float projectedLength = length(projected);
  vec3 tangent = cross(axis, projected / projectedLength);
  float cosNormalAngle = clamp(dot(projected, view) / projectedLength, -1.0, 1.0);
  float sinNormalAngle = -dot(view, tangent);
  float normalAngle = sign(sinNormalAngle) * acos(cosNormalAngle);
  vec2 step = radiusInPixels(point, direction.xy) / float(stepsPerSide);
  vec3 up = point.normal / projectedLength;
  vec2 right = horizon(point, up, tangent, step, shift);
  vec2 left = horizon(point, up, -tangent, -step, shift);
  float rightmost = normalAngle + signedAngle(right);
  float leftmost = normalAngle - signedAngle(left);
  // cos(2 (n + t) - n) = cos(n) cos(2 t) - sin(n) sin(2 t)
  vec2 cosines = cosNormalAngle * (2.0 * vec2(right.x * right.x, left.x * left.x) - 1.0) -
    2.0 * sinNormalAngle * vec2(right.x * right.y, -left.x * left.y);
  float open = integrateArcCosWeight(rightmost, cosines.x, cosNormalAngle, sinNormalAngle) -
    integrateArcCosWeight(leftmost, cosines.y, cosNormalAngle, sinNormalAngle);
  return projectedLength *
    (cosNormalAngle + normalAngle * sinNormalAngle - (leftmost < rightmost ? open : 0.0));
}

float occlusionAt(SurfacePoint point, int pointCount)
{
  vec3 view = towardEye(point.position);
  float sum = 0.0;
  int i = 0;
  do
  {
    vec4 xi = pixelSample(i, point.pixel);
    sum += sliceOcclusion(point, view, pi * xi.x, xi.y);
    ++i;
  } while (i < pointCount);
  return sum / float(pointCount);
}
