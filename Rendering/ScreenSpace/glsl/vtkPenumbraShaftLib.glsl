// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A homogeneous medium and one light in it: what a view ray scatters towards the eye where it is lit
// [Shafts eq. 1]. Coordinates are those of the eye with z along the view axis; the share of a view
// ray is a coordinate along it in which a lit ray scatters evenly (directional lights) or nearly so.
uniform vec4 light;         // where it is (w = 1), or the unit direction towards it (w = 0)
uniform float scattering;   // per unit of length
uniform float extinction;
uniform int phase;          // vtkPenumbraLightShaftPass::Phases
uniform float asymmetry;
uniform vec3 attenuation;   // constant, linear, quadratic
uniform vec4 cone;          // the way a spot shines, and the cosine of its cone; -2: none
uniform float coneExponent;

const float wholeSphere = 12.5663706;
const float endOfSight = 18.0; // mean free paths after which nothing is left
const float thin = 1e-3;       // optical depth below which exp(-x) = 1 - x

struct Sight
{
  vec2 plane;     // where the ray meets the plane at distance 1 (parallel: anywhere)
  vec3 direction; // unit
  float reach;    // length for each unit of depth
  float end;      // length at which the ray ends
  float closest;  // length at which it passes the light, and how far from it
  float pass;
  vec2 angles;    // from the light, of beginning and end
};

vec3 startOf(vec2 plane)
{
  return perspective > 0.5 ? vec3(0.0) : vec3(plane, 0.0);
}

Sight sightThrough(vec2 pixel, float eyeDepth)
{
  Sight sight;
  sight.plane = pixelToEye.xy * pixel + pixelToEye.zw;
  vec3 way = vec3(perspective * sight.plane, 1.0);
  sight.reach = length(way);
  sight.direction = way / sight.reach;
  sight.end = min(eyeDepth * sight.reach, endOfSight / extinction);
  vec3 towards = light.xyz - startOf(sight.plane);
  sight.closest = dot(towards, sight.direction);
  sight.pass = max(length(towards - sight.closest * sight.direction), 1e-5 * sight.end);
  sight.angles = atan((vec2(0.0, sight.end) - sight.closest) / sight.pass);
  return sight;
}

float phaseFunction(float cosine)
{
  float g = asymmetry;
  float base = max(1.0 + g * g - 2.0 * g * cosine, 1e-6);
  float forward = (1.0 - g * g) / (base * sqrt(base));
  float rayleigh = 0.75 * (1.0 + cosine * cosine);
  return (phase == 2 ? forward : phase == 1 ? rayleigh : 1.0) / wholeSphere;
}

// The share at which a ray has a length.
float shareOfLength(Sight sight, float span)
{
  float whole = extinction * sight.end;
  float fades = whole < thin
    ? span / sight.end
    : (1.0 - exp(-extinction * span)) / (1.0 - exp(-whole));
  float turns = (atan((span - sight.closest) / sight.pass) - sight.angles.x) /
    max(sight.angles.y - sight.angles.x, 1e-9);
  return clamp(light.w > 0.5 ? turns : fades, 0.0, 1.0);
}

// What a lamp's lit ray scatters at a share, for each unit of share.
float lampScatters(Sight sight, float share)
{
  float angle = mix(sight.angles.x, sight.angles.y, share);
  float aside = sight.pass * tan(angle);
  float span = sight.closest + aside;
  vec3 way = light.xyz - startOf(sight.plane) - span * sight.direction;
  float away = length(way);
  vec3 towards = way / away;
  float cosine = -dot(towards, cone.xyz);
  float spot = cone.w < -1.5 ? 1.0 : cosine < cone.w ? 0.0 : pow(max(cosine, 0.0), coneExponent);
  float strength = spot / max(dot(attenuation, vec3(1.0, away, away * away)), 1e-20);
  float stretch = (sight.pass + aside * aside / sight.pass) * (sight.angles.y - sight.angles.x);
  return stretch * strength * scattering * phaseFunction(dot(towards, sight.direction)) *
    exp(-extinction * (span + away));
}

// What a lit ray scatters in all, but for the light's colour.
float scatteredIn(Sight sight)
{
  if (light.w < 0.5)
  {
    float whole = extinction * sight.end;
    float path = whole < thin ? sight.end : (1.0 - exp(-whole)) / extinction;
    return path * scattering * phaseFunction(dot(light.xyz, sight.direction));
  }
  const int pieces = 32;
  float sum = 0.0;
  for (int i = 0; i < pieces; ++i)
  {
    sum += lampScatters(sight, (float(i) + 0.5) / float(pieces));
  }
  return sum / float(pieces);
}
