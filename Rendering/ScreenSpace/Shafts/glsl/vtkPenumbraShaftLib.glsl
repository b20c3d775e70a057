// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A homogeneous medium and lights in it: what a view ray scatters towards the eye where it is lit
// [Shafts eq. 1]. Coordinates are those of the eye with z along the view axis. The lights' own piece
// follows: the share of a view ray is a coordinate along it in which a lit ray scatters evenly (a sun)
// or nearly so (a lamp).
uniform vec4 lights[3];     // where each is (w = 1), or the unit direction towards it (w = 0)
uniform int lightCount;
uniform float scattering;   // per unit of length
uniform float extinction;
uniform int phase;          // vtkPenumbraLightShaftPass::Phases
uniform float asymmetry;

vec4 light;                 // the one at work

const float wholeSphere = 12.5663706;
const float thin = 1e-3; // optical depth below which exp(-x) = 1 - x

struct Sight
{
  vec2 plane;     // where the ray meets the plane at distance 1 (parallel: anywhere)
  vec3 start;     // of the ray
  vec3 direction; // unit
  float reach;    // length for each unit of depth
  float begin;    // length at which the ray enters the medium
  float end;      // and at which it ends or leaves it
  float through;  // between, in the medium
  float closest;  // lamps: length at which it passes the light, and how far from it
  float pass;
  vec2 angles;    // lamps: from the light, of beginning and end
};

float phaseFunction(float cosine)
{
  float value = 1.0;
  if (phase == 1)
  {
    value = 0.75 * (1.0 + cosine * cosine);
  }
  else if (phase == 2)
  {
    float base = max(1.0 + asymmetry * (asymmetry - 2.0 * cosine), 1e-6);
    value = (1.0 - asymmetry * asymmetry) / (base * sqrt(base));
  }
  return value / wholeSphere;
}

//VTK::Penumbra::Medium

Sight sightAlong(vec2 pixel, float eyeDepth)
{
  Sight sight;
  sight.plane = pixelToEye.xy * pixel + pixelToEye.zw;
  vec3 way = vec3(perspective * sight.plane, 1.0);
  sight.reach = length(way);
  sight.direction = way / sight.reach;
  sight.start = perspective > 0.5 ? vec3(0.0) : vec3(sight.plane, 0.0);
  vec2 span = spanInMedium(sight.start, sight.direction, eyeDepth * sight.reach);
  sight.begin = span.x;
  sight.end = span.y;
  sight.through = span.y - span.x;
  return sight;
}

//VTK::Penumbra::Light
