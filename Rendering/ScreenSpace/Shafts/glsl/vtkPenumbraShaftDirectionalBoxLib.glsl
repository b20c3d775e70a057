// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Light from infinitely far into a medium with bounds, where its way through the medium differs from
// point to point: bins of equal loss along the view ray.

Sight sightThrough(vec2 pixel, float eyeDepth)
{
  return sightAlong(pixel, eyeDepth);
}

// What is lost along a length.
float lossOver(float span)
{
  float depth = extinction * span;
  return depth < thin ? depth : 1.0 - exp(-depth);
}

// The share at which a ray has a length.
float shareOfLength(Sight sight, float span)
{
  float whole = max(lossOver(sight.end - sight.begin), 1e-20);
  return clamp(lossOver(max(span - sight.begin, 0.0)) / whole, 0.0, 1.0);
}

// What is left of the light where a share of the view ray has passed.
float leftAt(Sight sight, float share)
{
  float whole = lossOver(sight.end - sight.begin);
  float lost = share * whole;
  float span = sight.begin + (whole < thin ? lost : -log(max(1.0 - lost, 1e-8))) / extinction;
  vec3 point = sight.start + span * sight.direction;
  return exp(-extinction * wayInMedium(point, light.xyz, 1e18));
}

// What a lit ray scatters in all, but for the light's colour.
float scatteredIn(Sight sight)
{
  const int pieces = 32;
  float sum = 0.0;
  for (int i = 0; i < pieces; ++i)
  {
    sum += leftAt(sight, (float(i) + 0.5) / float(pieces));
  }
  float path = lossOver(sight.end - sight.begin) / extinction;
  return path * scattering * phaseFunction(dot(light.xyz, sight.direction)) * sum / float(pieces);
}

// The lit part of what the ray scatters; each of 64 shadowed bins of shares is a bit.
float litOf(Sight sight, uvec2 shadowed)
{
  vec2 sums = vec2(0.0);
  for (int i = 0; i < 64; ++i)
  {
    float amount = leftAt(sight, (float(i) + 0.5) / 64.0);
    uint word = i < 32 ? shadowed.x : shadowed.y;
    sums += amount * vec2(1.0, float(1u - ((word >> uint(i & 31)) & 1u)));
  }
  return sums.x > 0.0 ? sums.y / sums.x : 1.0;
}
