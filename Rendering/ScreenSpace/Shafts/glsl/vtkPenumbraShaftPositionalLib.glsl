// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Positional light with the attenuation and cone of vtkLight. Bins along the view ray subtend equal
// angles at the light (equiangular sampling).
uniform vec3 attenuation;   // constant, linear, quadratic
uniform vec4 cone;          // xyz: direction of a spotlight, w: cosine of its cone angle; -2: no cone
uniform float coneExponent;

const float maximumOpticalDepth = 18.0; // exp(-18) is below 2e-8: the rest of the ray is invisible

// Limits the angles of a view ray to the cone of a spotlight. A cone of less than 90 degrees is convex,
// so that the ray has one part in it.
vec2 clipToCone(vec2 angles, ViewRay ray, vec3 toLight)
{
  // At the angle a, the point minus the light is lightDistance * (across + tan(a) * direction).
  vec3 across = (ray.closestApproach * ray.direction - toLight) / ray.lightDistance;
  // Its cosine with the cone's axis: amplitude * cos(a - phase).
  vec2 axis = vec2(dot(across, cone.xyz), dot(ray.direction, cone.xyz));
  float amplitude = length(axis);
  float phase = amplitude > 1e-9 ? atan(axis.y, axis.x) : 0.0; // atan(0, 0) is undefined
  float halfWidth = acos(clamp(cone.w / max(amplitude, 1e-9), -1.0, 1.0));
  vec2 inside = clamp(vec2(phase - halfWidth, phase + halfWidth), angles.x, angles.y);
  return cone.w < -1.5 ? angles : inside;
}

ViewRay makeViewRay(vec2 pixel, float eyeDepth)
{
  ViewRay ray = clipViewRay(pixel, eyeDepth);
  ray.end = min(ray.end, ray.begin + lengthOfColumn(ray, maximumOpticalDepth / extinction));
  vec3 toLight = light.xyz - ray.start;
  ray.closestApproach = dot(toLight, ray.direction);
  ray.lightDistance = max(length(toLight - ray.closestApproach * ray.direction), 1e-5 * ray.end);
  ray.angles = atan((vec2(ray.begin, ray.end) - ray.closestApproach) / ray.lightDistance);
  ray.angles = clipToCone(ray.angles, ray, toLight);
  return ray;
}

// Coordinate in [0, 1] of the point at a length along the ray.
float cdfOfLength(ViewRay ray, float span)
{
  float angle = atan((span - ray.closestApproach) / ray.lightDistance) - ray.angles.x;
  return clamp(angle / max(ray.angles.y - ray.angles.x, 1e-9), 0.0, 1.0);
}

// Length along the ray of the point at the coordinate `cdf`.
float lengthOfCdf(ViewRay ray, float cdf)
{
  return ray.closestApproach + ray.lightDistance * tan(mix(ray.angles.x, ray.angles.y, cdf));
}

// In-scattering of a lit ray per unit of the coordinate `cdf`.
float inScatteringDensity(ViewRay ray, float cdf)
{
  float angle = mix(ray.angles.x, ray.angles.y, cdf);
  float offset = ray.lightDistance * tan(angle);
  float span = ray.closestApproach + offset;
  vec3 point = ray.start + span * ray.direction;
  vec3 toLight = light.xyz - point;
  float distanceToLight = length(toLight);
  vec3 direction = toLight / distanceToLight;
  float cosine = -dot(direction, cone.xyz);
  float spot = cone.w < -1.5 ? 1.0 : cosine < cone.w ? 0.0 : pow(max(cosine, 0.0), coneExponent);
  float strength =
    spot / max(dot(attenuation, vec3(1.0, distanceToLight, distanceToLight * distanceToLight)), 1e-20);
  float lengthPerCdf =
    (ray.lightDistance + offset * offset / ray.lightDistance) * (ray.angles.y - ray.angles.x);
  return scatteredLight(lengthPerCdf * strength, dot(direction, ray.direction)) *
    densityAt(point) *
    exp(-extinction *
      (columnOfRay(ray, span - ray.begin) + columnToLight(point, direction, distanceToLight)));
}

// In-scattering of a fully lit ray for a light of color 1.
float inScattering(ViewRay ray)
{
  const int intervals = 32;
  float sum = 0.0;
  for (int i = 0; i < intervals; ++i)
  {
    sum += inScatteringDensity(ray, (float(i) + 0.5) / float(intervals));
  }
  return sum / float(intervals);
}

// In-scattering of a lit ray per unit of the coordinate `cdf`, and its mean over the ray.
float inScatteringWeight(ViewRay ray, float cdf)
{
  return inScatteringDensity(ray, cdf);
}

float meanInScatteringWeight(ViewRay ray)
{
  return inScattering(ray);
}

// Lit fraction of the in-scattering; each bit marks one of 64 bins as shadowed.
float litFractionOf(ViewRay ray, uvec2 shadowed)
{
  vec2 sums = vec2(0.0);
  for (int i = 0; i < 64; ++i)
  {
    float amount = inScatteringDensity(ray, (float(i) + 0.5) / 64.0);
    uint word = i < 32 ? shadowed.x : shadowed.y;
    sums += amount * vec2(1.0, float(1u - ((word >> uint(i & 31)) & 1u)));
  }
  return sums.x > 0.0 ? sums.y / sums.x : 1.0;
}
