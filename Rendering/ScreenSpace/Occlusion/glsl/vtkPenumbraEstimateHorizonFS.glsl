// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The horizon kernel: through the eye and the point runs a slice; the highest surface on either side
// within the radius is the horizon, and what lies below it is blocked. The cosine integral over a
// slice is closed [Jimenez et al. 2016, GTAO eq. 7]; here the blocked part is summed, not the open
// one, so that an open plane gives 0 in every slice and not only on average.
// Assumes: what is seen reaches infinitely far back. D = 1 up to the radius.

const int stepsPerSide = 4; // a sample of the sequence is one slice of 2 * stepsPerSide fetches

// The integral over a slice of cos(t - tilt) |sin t| from the view direction to an angle t. Sines and
// cosines of angles that stem from vectors are at hand; here those of the tilt, and cos(2 t - tilt).
float arc(float angle, float cosineOfTwice, float cosTilt, float sinTilt)
{
  return 0.25 * sign(angle) * (cosTilt - cosineOfTwice + 2.0 * angle * sinTilt);
}

// How far up one side is blocked: cosine and sine of the angle between the normal within the slice and
// the highest surface found, the sine negative beyond the normal. Heights are taken over the tangent
// plane, so that the centres of pixels beside the slice's line do no harm. `up` is the normal divided by
// its share in the slice, `outwards` the tangent.
vec2 horizon(SurfacePoint point, vec3 up, vec3 outwards, vec2 step, float shift)
{
  vec2 highest = vec2(0.0, 1.0);
  for (int i = 0; i < stepsPerSide; ++i)
  {
    vec3 way = eyePositionAt(point.pixel + step * (float(i) + shift)) - point.position;
    vec2 found = vec2(dot(way, up), dot(way, outwards));
    // Heights are positive: which angle is the smaller one needs no division.
    bool higher = found.x > 0.0 && found.y * highest.x < highest.y * found.x;
    highest = dot(way, way) < 1.0 && higher ? found : highest;
  }
  return normalize(highest);
}

float angleOf(vec2 direction)
{
  return sign(direction.y) * acos(direction.x);
}

float sliceOcclusion(SurfacePoint point, vec3 view, float azimuth, float shift)
{
  vec3 direction = vec3(cos(azimuth), sin(azimuth), 0.0);
  vec3 axis = normalize(cross(view, direction));
  vec3 projected = point.normal - axis * dot(point.normal, axis);
  float share = length(projected);
  vec3 outwards = cross(axis, projected / share);
  float cosTilt = clamp(dot(projected, view) / share, -1.0, 1.0);
  float sinTilt = -dot(view, outwards);
  float tilt = sign(sinTilt) * acos(cosTilt);
  vec2 step = direction.xy * radiusInPixels(point) / float(stepsPerSide);
  vec3 up = point.normal / share;
  vec2 right = horizon(point, up, outwards, step, shift);
  vec2 left = horizon(point, up, -outwards, -step, shift);
  float rightmost = tilt + angleOf(right);
  float leftmost = tilt - angleOf(left);
  // cos(2 (tilt + t) - tilt) = cos(tilt) cos(2 t) - sin(tilt) sin(2 t)
  vec2 cosines = cosTilt * (2.0 * vec2(right.x * right.x, left.x * left.x) - 1.0) -
    2.0 * sinTilt * vec2(right.x * right.y, -left.x * left.y);
  float open = arc(rightmost, cosines.x, cosTilt, sinTilt) - arc(leftmost, cosines.y, cosTilt, sinTilt);
  return share * (cosTilt + tilt * sinTilt - (leftmost < rightmost ? open : 0.0));
}

float occlusionAt(SurfacePoint point)
{
  vec3 view = towardsEye(point.position);
  float sum = 0.0;
  for (int i = 0; i < sampleCount; ++i)
  {
    vec4 xi = pixelSample(i, point.pixel);
    sum += sliceOcclusion(point, view, pi * xi.x, xi.y);
  }
  return sum / float(sampleCount);
}
