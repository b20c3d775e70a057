// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The march kernel: rays through one layer of depth, whose surfaces have a soft thickness. A slice
// through the eye and the point is searched as by the horizon kernel; against what was found on each
// side a fan of rays is held, each blocked with probability exp(-b / thickness), b the smallest
// distance by which it passes behind something. Rays that pass from before a surface to behind it
// within one step have met it. D = 1 up to the radius.

const int stepsPerSide = 4; // a sample of the sequence is one slice of 2 * stepsPerSide fetches
const int raysPerSide = 8; // measured: with 4 a tolerance takes twice the samples

// Neighbouring finds with less depth between them than this times their distance across the view
// belong to one surface.
const float steepest = 4.0;

// A ray this near to a surface, in radii, lies on it.
const float nearlyMet = 1e-3;

// Positions and directions in a slice: x across the view, away from the point, y towards the eye.
struct SliceSide
{
  vec2 normal; // of the surface, unit
  vec2 found[stepsPerSide];
  vec2 away[stepsPerSide]; // unit, from the eye through what was found
};

// `up` is the normal divided by its share in the slice: heights are taken over the tangent plane, so
// that the centres of pixels beside the slice's line do no harm.
SliceSide searchSide(SurfacePoint point, vec3 view, vec3 across, vec3 up, vec2 step, float shift)
{
  SliceSide side;
  side.normal = vec2(dot(up, across), dot(up, view));
  vec2 tangent = vec2(side.normal.y, -side.normal.x);
  vec3 along = tangent.x * across + tangent.y * view;
  for (int i = 0; i < stepsPerSide; ++i)
  {
    vec3 position = eyePositionAt(point.pixel + step * (float(i) + shift));
    vec3 way = position - point.position;
    vec3 away = perspective > 0.5 ? position : vec3(0.0, 0.0, -1.0);
    side.found[i] = dot(way, along) * tangent + dot(way, up) * side.normal;
    side.away[i] = normalize(vec2(dot(away, across), dot(away, view)));
  }
  return side;
}

// The probability that the ray in a unit direction is blocked.
float blocked(SliceSide side, vec2 ray)
{
  vec2 last = vec2(0.0);
  float lastGap = 0.0;
  float behind = 1e6;
  for (int i = 0; i < stepsPerSide; ++i)
  {
    // Where the line of sight through what was found meets the ray.
    vec2 found = side.found[i];
    float across = side.away[i].x * ray.y - side.away[i].y * ray.x;
    float gap = (found.y * ray.x - found.x * ray.y) / max(across, 1e-6);
    vec2 met = found + gap * side.away[i];
    // Or, from before a continuous surface to behind it, the surface between two finds.
    bool through = lastGap < nearlyMet && abs(found.y - last.y) < steepest * (found.x - last.x);
    met = through ? mix(last, found, lastGap / min(lastGap - gap, -1e-6)) : met;
    bool passes = across > 1e-6 && gap > nearlyMet && dot(met, met) < 1.0;
    behind = passes ? min(behind, through ? 0.0 : gap) : behind;
    last = found;
    lastGap = gap;
  }
  return exp(-behind / thickness);
}

// The part of a slice's cosine integral that one side blocks; `tilt` is the normal's angle, positive
// towards this side. Sines and cosines are dear: each ray is the one before it, turned.
float sideOcclusion(SliceSide side, float tilt, float shift)
{
  float width = min(tilt + 0.5 * pi, pi) / float(raysPerSide);
  mat2 turn = mat2(cos(width), -sin(width), sin(width), cos(width));
  vec2 ray = vec2(sin(shift * width), cos(shift * width));
  float sum = 0.0;
  for (int i = 0; i < raysPerSide; ++i)
  {
    sum += max(dot(ray, side.normal), 0.0) * ray.x * blocked(side, ray);
    ray = turn * ray;
  }
  return sum * width;
}

float sliceOcclusion(SurfacePoint point, vec3 view, vec4 xi)
{
  float azimuth = pi * xi.x;
  vec3 direction = vec3(cos(azimuth), sin(azimuth), 0.0);
  vec3 across = normalize(direction - view * dot(direction, view));
  vec3 axis = cross(view, across);
  vec3 projected = point.normal - axis * dot(point.normal, axis);
  float share = length(projected);
  float tilt = atan(dot(projected, across), dot(projected, view));
  vec2 step = direction.xy * radiusInPixels(point) / float(stepsPerSide);
  vec3 up = point.normal / share;
  SliceSide right = searchSide(point, view, across, up, step, xi.y);
  SliceSide left = searchSide(point, view, -across, up, -step, xi.y);
  return share * (sideOcclusion(right, tilt, xi.z) + sideOcclusion(left, -tilt, xi.z));
}

float occlusionAt(SurfacePoint point)
{
  vec3 view = towardsEye(point.position);
  float sum = 0.0;
  for (int i = 0; i < sampleCount; ++i)
  {
    sum += sliceOcclusion(point, view, pixelSample(i, point.pixel));
  }
  return sum / float(sampleCount);
}
