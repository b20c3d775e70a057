// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The march kernel: rays through one layer of depth, whose surfaces have a soft thickness. A slice
// through the camera and the point is sampled as by the horizon kernel. On each side a fan of rays
// is tested against the sampled surface points. A ray is blocked with probability exp(-b /
// thickness), where b is the smallest distance by which it passes behind a sampled point. A ray
// that goes from in front of a surface to behind it within one step hits that surface. D = 1 up to
// the radius.

const int stepsPerSide = 4; // a sample of the sequence is one slice of 2 * stepsPerSide fetches

// Two successive sampled points belong to one surface if their difference in depth is less than
// this multiple of their distance across the view.
const float maximumSlope = 4.0;

// Distance within which a ray counts as on a surface, in radii.
const float contactDistance = 1e-3;

// Positions and directions in a slice: x across the view, away from the point; y toward the
// camera.
struct SliceSide
{
  vec2 normal; // projected normal of the surface, divided by its length
  vec2 sampled[stepsPerSide];
  vec2 viewDirection[stepsPerSide]; // unit vectors from the camera through the sampled points
};

// Samples one side of a slice. `up` is the normal divided by its length projected into the slice.
// Heights are measured from the tangent plane, so that pixel centers off the line of the slice
// cause no error.
SliceSide searchSide(SurfacePoint point, vec3 view, vec3 across, vec3 up, vec2 step, float shift)
{
  SliceSide side;
  side.normal = vec2(dot(up, across), dot(up, view));
  vec2 tangent = vec2(side.normal.y, -side.normal.x);
  vec3 along = tangent.x * across + tangent.y * view;
  for (int i = 0; i < stepsPerSide; ++i)
  {
    vec3 position = eyePositionAt(point.pixel + step * (float(i) + shift));
    vec3 offset = position - point.position;
    vec3 viewDirection = perspective > 0.5 ? position : vec3(0.0, 0.0, -1.0);
    side.sampled[i] = dot(offset, along) * tangent + dot(offset, up) * side.normal;
    side.viewDirection[i] = normalize(vec2(dot(viewDirection, across), dot(viewDirection, view)));
  }
  return side;
}

// Returns the probability that the ray in a unit direction is blocked.
float blockedProbability(SliceSide side, vec2 ray)
{
  vec2 previous = vec2(0.0);
  float previousGap = 0.0;
  float behind = 1e6;
  for (int i = 0; i < stepsPerSide; ++i)
  {
    // Intersection of the ray with the view ray behind the sampled point.
    vec2 sampled = side.sampled[i];
    float across = side.viewDirection[i].x * ray.y - side.viewDirection[i].y * ray.x;
    float gap = (sampled.y * ray.x - sampled.x * ray.y) / max(across, 1e-6);
    vec2 hit = sampled + gap * side.viewDirection[i];
    // If the ray crosses a continuous surface, the intersection with the segment between two
    // points.
    bool crosses = previousGap < contactDistance &&
      abs(sampled.y - previous.y) < maximumSlope * (sampled.x - previous.x);
    hit = crosses ? mix(previous, sampled, previousGap / min(previousGap - gap, -1e-6)) : hit;
    bool passes = across > 1e-6 && gap > contactDistance && dot(hit, hit) < 1.0;
    behind = passes ? min(behind, crosses ? 0.0 : gap) : behind;
    previous = sampled;
    previousGap = gap;
  }
  return exp(-behind / thickness);
}

// Returns the part of the cosine-weighted integral over a slice that one side blocks. `normalAngle`
// is the angle of the projected normal, positive toward this side. Each ray is the previous one,
// rotated, because trigonometric functions are expensive.
float sideOcclusion(SliceSide side, float normalAngle, float shift)
{
  float width = min(normalAngle + 0.5 * pi, pi) / float(raysPerSide);
  mat2 rotation = mat2(cos(width), -sin(width), sin(width), cos(width));
  vec2 ray = vec2(sin(shift * width), cos(shift * width));
  float sum = 0.0;
  for (int i = 0; i < raysPerSide; ++i)
  {
    sum += max(dot(ray, side.normal), 0.0) * ray.x * blockedProbability(side, ray);
    ray = rotation * ray;
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
  float projectedLength = length(projected);
  float normalAngle = atan(dot(projected, across), dot(projected, view));
  vec2 step = radiusInPixels(point, direction.xy) / float(stepsPerSide);
  vec3 up = point.normal / projectedLength;
  SliceSide right = searchSide(point, view, across, up, step, xi.y);
  SliceSide left = searchSide(point, view, -across, up, -step, xi.y);
  return projectedLength *
    (sideOcclusion(right, normalAngle, xi.z) + sideOcclusion(left, -normalAngle, xi.z));
}

float occlusionAt(SurfacePoint point, int pointCount)
{
  vec3 view = towardEye(point.position);
  float sum = 0.0;
  int i = 0;
  do
  {
    sum += sliceOcclusion(point, view, pixelSample(i, point.pixel));
    ++i;
  } while (i < pointCount);
  return sum / float(pointCount);
}
