// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A medium that fills an axis-aligned box in world coordinates.
uniform mat4 eyeToWorld; // rotation only: the eye stays the origin
uniform vec3 boxMinimum; // corners of the box relative to the eye, in world axes
uniform vec3 boxMaximum;

// Lengths at which a line enters and leaves the box (slab test).
vec2 intersectBox(vec3 start, vec3 direction)
{
  vec3 slope = mat3(eyeToWorld) * direction;
  slope = mix(vec3(-1.0), vec3(1.0), step(0.0, slope)) * max(abs(slope), 1e-9);
  vec3 origin = mat3(eyeToWorld) * start;
  vec3 toMinimum = (boxMinimum - origin) / slope;
  vec3 toMaximum = (boxMaximum - origin) / slope;
  vec3 near = min(toMinimum, toMaximum);
  vec3 far = max(toMinimum, toMaximum);
  return vec2(max(max(near.x, near.y), near.z), min(min(far.x, far.y), far.z));
}

// Lengths at which a ray of length `end` enters and leaves the medium.
vec2 clipToMedium(vec3 start, vec3 direction, float end)
{
  vec2 span = clamp(intersectBox(start, direction), 0.0, end);
  return vec2(span.x, max(span.x, span.y));
}

// Length inside the medium of the path from a point in it to a light at distance `lightDistance`.
float lengthInMedium(vec3 point, vec3 toLight, float lightDistance)
{
  return clamp(intersectBox(point, toLight).y, 0.0, lightDistance);
}
