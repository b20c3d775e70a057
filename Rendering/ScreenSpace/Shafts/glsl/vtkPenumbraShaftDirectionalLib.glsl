// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Light from infinitely far in a medium without end: all in closed form.

Sight sightThrough(vec2 pixel, float eyeDepth)
{
  return sightAlong(pixel, eyeDepth);
}

// What is lost along a length, and what is scattered, are in proportion.
float lossOver(float span)
{
  float depth = extinction * span;
  return depth < thin ? depth : 1.0 - exp(-depth);
}

// The share at which a ray has a length.
float shareOfLength(Sight sight, float span)
{
  return clamp(lossOver(span) / max(lossOver(sight.end), 1e-20), 0.0, 1.0);
}

// What a lit ray scatters in all, but for the light's colour.
float scatteredIn(Sight sight)
{
  float path = lossOver(sight.end) / extinction;
  return path * scattering * phaseFunction(dot(light.xyz, sight.direction));
}

float countBits(uvec2 bits)
{
  bits = (bits & 0x55555555u) + ((bits >> 1) & 0x55555555u);
  bits = (bits & 0x33333333u) + ((bits >> 2) & 0x33333333u);
  bits = (bits & 0x0f0f0f0fu) + ((bits >> 4) & 0x0f0f0f0fu);
  bits = (bits * 0x01010101u) >> 24;
  return float(bits.x + bits.y);
}

// The lit part of what the ray scatters; each of 64 shadowed bins of shares is a bit.
float litOf(Sight sight, uvec2 shadowed)
{
  return 1.0 - countBits(shadowed) / 64.0;
}
