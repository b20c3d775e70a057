// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Light from a point, with VTK's attenuation and cone: bins of equal angles seen from the light.
uniform vec3 attenuation;   // constant, linear, quadratic
uniform vec4 cone;          // the way a spot shines, and the cosine of its cone; -2: none
uniform float coneExponent;

const float endOfSight = 18.0; // mean free paths after which nothing is left

Sight sightThrough(vec2 pixel, float eyeDepth)
{
  Sight sight = sightAlong(pixel, eyeDepth);
  sight.end = min(sight.end, sight.begin + endOfSight / extinction);
  vec3 towards = light.xyz - sight.start;
  sight.closest = dot(towards, sight.direction);
  sight.pass = max(length(towards - sight.closest * sight.direction), 1e-5 * sight.end);
  sight.angles = atan((vec2(sight.begin, sight.end) - sight.closest) / sight.pass);
  return sight;
}

// The share at which a ray has a length.
float shareOfLength(Sight sight, float span)
{
  float angle = atan((span - sight.closest) / sight.pass) - sight.angles.x;
  return clamp(angle / max(sight.angles.y - sight.angles.x, 1e-9), 0.0, 1.0);
}

// What a lit ray scatters at a share, for each unit of share.
float lampScatters(Sight sight, float share)
{
  float angle = mix(sight.angles.x, sight.angles.y, share);
  float aside = sight.pass * tan(angle);
  float span = sight.closest + aside;
  vec3 point = sight.start + span * sight.direction;
  vec3 way = light.xyz - point;
  float away = length(way);
  vec3 towards = way / away;
  float cosine = -dot(towards, cone.xyz);
  float spot = cone.w < -1.5 ? 1.0 : cosine < cone.w ? 0.0 : pow(max(cosine, 0.0), coneExponent);
  float strength = spot / max(dot(attenuation, vec3(1.0, away, away * away)), 1e-20);
  float stretch = (sight.pass + aside * aside / sight.pass) * (sight.angles.y - sight.angles.x);
  return stretch * strength * scattering * phaseFunction(dot(towards, sight.direction)) *
    exp(-extinction * (span - sight.begin + wayInMedium(point, towards, away)));
}

// What a lit ray scatters in all, but for the light's colour.
float scatteredIn(Sight sight)
{
  const int pieces = 32;
  float sum = 0.0;
  for (int i = 0; i < pieces; ++i)
  {
    sum += lampScatters(sight, (float(i) + 0.5) / float(pieces));
  }
  return sum / float(pieces);
}

// The lit part of what the ray scatters; each of 64 shadowed bins of shares is a bit.
float litOf(Sight sight, uvec2 shadowed)
{
  vec2 sums = vec2(0.0);
  for (int i = 0; i < 64; ++i)
  {
    float amount = lampScatters(sight, (float(i) + 0.5) / 64.0);
    uint word = i < 32 ? shadowed.x : shadowed.y;
    sums += amount * vec2(1.0, float(1u - ((word >> uint(i & 31)) & 1u)));
  }
  return sums.x > 0.0 ? sums.y / sums.x : 1.0;
}
