// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Directional light in a medium with bounds or a fall-off, where the path of the light through the
// medium differs from point to point. Bins along the view ray have equal extinction.

ViewRay makeViewRay(vec2 pixel, float eyeDepth)
{
  return clipViewRay(pixel, eyeDepth);
}

// Fraction of the light that a path with this column in the medium extinguishes.
float extinguishedFraction(float column)
{
  float depth = extinction * column;
  return depth < thinOpticalDepth ? depth : 1.0 - exp(-depth);
}

// Coordinate in [0, 1] of the point at a length along the ray.
float cdfOfLength(ViewRay ray, float span)
{
  float total = max(extinguishedFraction(ray.column), 1e-20);
  float column = columnOfRay(ray, max(span - ray.begin, 0.0));
  return clamp(extinguishedFraction(column) / total, 0.0, 1.0);
}

// Length along the ray of the point at the coordinate `cdf`.
float lengthOfCdf(ViewRay ray, float cdf)
{
  float total = extinguishedFraction(ray.column);
  float lost = cdf * total;
  float column = (total < thinOpticalDepth ? lost : -log(max(1.0 - lost, 1e-8))) / extinction;
  return ray.begin + lengthOfColumn(ray, column);
}

// Transmittance between the light and the point at the coordinate `cdf` of the ray.
float transmittanceToLight(ViewRay ray, float cdf)
{
  vec3 point = ray.start + lengthOfCdf(ray, cdf) * ray.direction;
  return exp(-extinction * columnToLight(point, light.xyz, 1e18));
}

// In-scattering of a lit ray per unit of the coordinate `cdf`, and its mean over the ray.
float inScatteringWeight(ViewRay ray, float cdf)
{
  return transmittanceToLight(ray, cdf);
}

float meanInScatteringWeight(ViewRay ray)
{
  const int intervals = 32;
  float sum = 0.0;
  for (int i = 0; i < intervals; ++i)
  {
    sum += transmittanceToLight(ray, (float(i) + 0.5) / float(intervals));
  }
  return sum / float(intervals);
}

// In-scattering of a fully lit ray for a light of color 1.
float inScattering(ViewRay ray)
{
  float path = extinguishedFraction(ray.column) / extinction;
  return scatteredLight(path, dot(light.xyz, ray.direction)) * meanInScatteringWeight(ray);
}

// Lit fraction of the in-scattering; each bit marks one of 64 bins as shadowed.
float litFractionOf(ViewRay ray, uvec2 shadowed)
{
  vec2 sums = vec2(0.0);
  for (int i = 0; i < 64; ++i)
  {
    float amount = transmittanceToLight(ray, (float(i) + 0.5) / 64.0);
    uint word = i < 32 ? shadowed.x : shadowed.y;
    sums += amount * vec2(1.0, float(1u - ((word >> uint(i & 31)) & 1u)));
  }
  return sums.x > 0.0 ? sums.y / sums.x : 1.0;
}
