// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A medium that fills a box whose sides follow the world's axes.
uniform mat4 eyeToWorld; // turns alone: the eye stays the origin
uniform vec3 low;        // corners of the box, seen from the eye
uniform vec3 high;

vec2 crossings(vec3 start, vec3 direction)
{
  vec3 way = mat3(eyeToWorld) * direction;
  way = mix(vec3(-1.0), vec3(1.0), step(0.0, way)) * max(abs(way), 1e-9);
  vec3 from = mat3(eyeToWorld) * start;
  vec3 one = (low - from) / way;
  vec3 other = (high - from) / way;
  vec3 near = min(one, other);
  vec3 far = max(one, other);
  return vec2(max(max(near.x, near.y), near.z), min(min(far.x, far.y), far.z));
}

// Where a ray enters and leaves the medium.
vec2 spanInMedium(vec3 start, vec3 direction, float end)
{
  vec2 span = clamp(crossings(start, direction), 0.0, end);
  return vec2(span.x, max(span.x, span.y));
}

// How much of the way from a point to a light `away` lies in the medium.
float wayInMedium(vec3 point, vec3 towards, float away)
{
  return clamp(crossings(point, towards).y, 0.0, away);
}
