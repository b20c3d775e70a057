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
  float continues[stepsPerSide]; // 1 if a sampled point belongs to the surface of the previous one
  // The length along a ray at which it meets a segment is a quotient. Its dividend depends on the
  // segment only: that between two sampled points, or the view ray behind one.
  float betweenPoints[stepsPerSide];
  float alongView[stepsPerSide];
};

float cross2(vec2 a, vec2 b)
{
  return a.x * b.y - a.y * b.x;
}

// Returns the eye depths of the sampled points of one side. They are fetched before anything is
// computed from them: some drivers save all intermediate results at each fetch.
float[stepsPerSide] depthsAlong(vec2 pixel, vec2 step, float shift)
{
  float depths[stepsPerSide];
  for (int i = 0; i < stepsPerSide; ++i)
  {
    depths[i] = eyeDepthAt(pixel + step * (float(i) + shift));
  }
  return depths;
}

// Computes from the sampled points of a side what all rays have in common.
void connectPoints(inout SliceSide side)
{
  vec2 previous = vec2(0.0);
  for (int i = 0; i < stepsPerSide; ++i)
  {
    vec2 sampled = side.sampled[i];
    side.continues[i] =
      abs(sampled.y - previous.y) < maximumSlope * (sampled.x - previous.x) ? 1.0 : 0.0;
    side.betweenPoints[i] = abs(cross2(previous, sampled));
    side.alongView[i] = abs(cross2(side.viewDirection[i], sampled));
    previous = sampled;
  }
}

// Samples one side of a slice. `up` is the normal divided by its length projected into the slice.
// Heights are measured from the tangent plane, so that pixel centers off the line of the slice
// cause no error.
SliceSide searchSide(SurfacePoint point, vec3 view, vec3 across, vec3 up, vec2 step, float shift,
  float depths[stepsPerSide])
{
  SliceSide side;
  side.normal = vec2(dot(up, across), dot(up, view));
  vec2 tangent = vec2(side.normal.y, -side.normal.x);
  vec3 along = tangent.x * across + tangent.y * view;
  for (int i = 0; i < stepsPerSide; ++i)
  {
    vec2 pixel = floor(point.pixel + step * (float(i) + shift)) + 0.5;
    vec3 position = eyePosition(pixel, depths[i]);
    vec3 offset = position - point.position;
    vec3 viewDirection = perspective > 0.5 ? position : vec3(0.0, 0.0, -1.0);
    side.sampled[i] = dot(offset, along) * tangent + dot(offset, up) * side.normal;
    side.viewDirection[i] = normalize(vec2(dot(viewDirection, across), dot(viewDirection, view)));
  }
  connectPoints(side);
  return side;
}

// Returns the probability that the ray in a unit direction is blocked.
float blockedProbability(SliceSide side, vec2 ray)
{
  float previousHeight = 0.0;
  bool wasBehind = false;
  float behind = 1e6;
  for (int i = 0; i < stepsPerSide; ++i)
  {
    // The ray passes at a height below the sampled point and meets the view ray behind it at a gap.
    float across = cross2(side.viewDirection[i], ray);
    float height = cross2(ray, side.sampled[i]);
    float gap = height / max(across, 1e-6);
    // If the ray crosses a continuous surface, the intersection is that with the segment between two
    // points. Intersections count up to the radius, 1.
    bool crosses = side.continues[i] > 0.5 && !wasBehind;
    bool isNear =
      crosses ? side.betweenPoints[i] < abs(height - previousHeight) : side.alongView[i] < across;
    wasBehind = gap > contactDistance;
    bool passes = isNear && across > 1e-6 && wasBehind;
    float distance = crosses ? 0.0 : gap;
    behind = passes && distance < behind ? distance : behind;
    previousHeight = height;
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
  vec2 step = radiusInPixels(point, direction.xy) / float(stepsPerSide);
  float depthsRight[stepsPerSide] = depthsAlong(point.pixel, step, xi.y);
  float depthsLeft[stepsPerSide] = depthsAlong(point.pixel, -step, xi.y);
  vec3 across = normalize(direction - view * dot(direction, view));
  vec3 axis = cross(view, across);
  vec3 projected = point.normal - axis * dot(point.normal, axis);
  float projectedLength = length(projected);
  float normalAngle = atan(dot(projected, across), dot(projected, view));
  vec3 up = point.normal / projectedLength;
  SliceSide right = searchSide(point, view, across, up, step, xi.y, depthsRight);
  SliceSide left = searchSide(point, view, -across, up, -step, xi.y, depthsLeft);
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
