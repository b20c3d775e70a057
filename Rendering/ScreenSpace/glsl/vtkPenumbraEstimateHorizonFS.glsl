// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The horizon kernel: through the eye and the point runs a slice; the highest surface on either side
// within the radius is the horizon, and what lies below it is blocked. The cosine integral over a
// slice is closed [Jimenez et al. 2016, GTAO eq. 7]; here the blocked part is summed, not the open
// one, so that an open plane gives 0 in every slice and not only on average.
// Assumes: what is seen reaches infinitely far back. D = 1 up to the radius.

const int stepsPerSide = 4; // a sample of the sequence is one slice of 2 * stepsPerSide fetches

// The integral over a slice of cos(t - tilt) |sin t| from the view direction to the angle.
float arc(float angle, float tilt)
{
  return 0.25 * sign(angle) * (cos(tilt) - cos(2.0 * angle - tilt) + 2.0 * angle * sin(tilt));
}

// How far up one side is blocked: the largest cosine of an angle to the normal within the slice,
// continued as 2 - cosine beyond the normal. Heights are taken over the tangent plane, so that the
// centres of pixels beside the slice's line do no harm. `up` is the normal divided by its share in
// the slice, `outwards` the tangent.
float horizon(SurfacePoint point, vec3 up, vec3 outwards, vec2 step, float shift)
{
  float highest = 0.0;
  for (int i = 0; i < stepsPerSide; ++i)
  {
    vec3 way = eyePositionAt(point.pixel + step * (float(i) + shift)) - point.position;
    float height = dot(way, up);
    float aside = dot(way, outwards);
    float cosine = height * inversesqrt(max(height * height + aside * aside, 1e-12));
    float level = aside < 0.0 ? 2.0 - cosine : cosine;
    highest = dot(way, way) < 1.0 && height > 0.0 ? max(highest, level) : highest;
  }
  return highest;
}

// The angle from the normal at which a level lies; negative beyond the normal.
float angleOfLevel(float level)
{
  return level > 1.0 ? -acos(2.0 - level) : acos(level);
}

float sliceOcclusion(SurfacePoint point, vec3 view, float azimuth, float shift)
{
  vec3 direction = vec3(cos(azimuth), sin(azimuth), 0.0);
  vec3 axis = normalize(cross(view, direction));
  vec3 projected = point.normal - axis * dot(point.normal, axis);
  float share = length(projected);
  vec3 outwards = cross(axis, projected / share);
  float tilt = -sign(dot(view, outwards)) * acos(clamp(dot(projected, view) / share, -1.0, 1.0));
  vec2 step = direction.xy * radiusInPixels(point) / float(stepsPerSide);
  vec3 up = point.normal / share;
  float right = tilt + angleOfLevel(horizon(point, up, outwards, step, shift));
  float left = min(tilt - angleOfLevel(horizon(point, up, -outwards, -step, shift)), right);
  float quarter = 0.5 * pi;
  return share *
    (arc(tilt + quarter, tilt) - arc(right, tilt) + arc(left, tilt) - arc(tilt - quarter, tilt));
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
