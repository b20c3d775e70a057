// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Directional light in an unbounded medium: everything has a closed form.

ViewRay makeViewRay(vec2 pixel, float eyeDepth)
{
  return clipViewRay(pixel, eyeDepth);
}

// Fraction of the light that a path of this length in the medium extinguishes.
// In-scattering is proportional to it.
float extinguishedFraction(float span)
{
  float depth = extinction * span;
  return depth < thinOpticalDepth ? depth : 1.0 - exp(-depth);
}

// Coordinate in [0, 1] of the point at a length along the ray.
float cdfOfLength(ViewRay ray, float span)
{
  return clamp(extinguishedFraction(span) / max(extinguishedFraction(ray.end), 1e-20), 0.0, 1.0);
}

// Length along the ray of the point at the coordinate `cdf`.
float lengthOfCdf(ViewRay ray, float cdf)
{
  float total = extinguishedFraction(ray.end);
  float lost = cdf * total;
  return (total < thinOpticalDepth ? lost : -log(max(1.0 - lost, 1e-8))) / extinction;
}

// In-scattering of a lit ray per unit of the coordinate `cdf`, and its mean over the ray.
float inScatteringWeight(ViewRay ray, float cdf)
{
  return 1.0;
}

float meanInScatteringWeight(ViewRay ray)
{
  return 1.0;
}

// In-scattering of a fully lit ray for a light of color 1.
float inScattering(ViewRay ray)
{
  float path = extinguishedFraction(ray.end) / extinction;
  return scatteredLight(path, dot(light.xyz, ray.direction));
}

float countBits(uvec2 bits)
{
  bits = (bits & 0x55555555u) + ((bits >> 1) & 0x55555555u);
  bits = (bits & 0x33333333u) + ((bits >> 2) & 0x33333333u);
  bits = (bits & 0x0f0f0f0fu) + ((bits >> 4) & 0x0f0f0f0fu);
  bits = (bits * 0x01010101u) >> 24;
  return float(bits.x + bits.y);
}

// Lit fraction of the in-scattering; each bit marks one of 64 bins as shadowed.
float litFractionOf(ViewRay ray, uvec2 shadowed)
{
  return 1.0 - countBits(shadowed) / 64.0;
}
