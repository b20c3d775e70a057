// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A homogeneous medium and its lights: single scattering along view rays toward the eye [Shafts
// eq. 1]. Coordinates are eye coordinates with z along the view axis. The library of the light type
// follows at the end. Its CDF maps lengths along a view ray to [0, 1] so that equal intervals
// scatter equal (directional light) or similar (positional light) amounts of light while the ray is
// lit.
uniform vec4 lights[3];     // positions (w = 1), or unit directions toward the lights (w = 0)
uniform int lightCount;
uniform float scattering;   // coefficients per unit of length
uniform float extinction;
uniform int phase;          // vtkPenumbraLightShaftPass::Phases
uniform float asymmetry;    // mean cosine of HENYEY_GREENSTEIN

vec4 light;                 // the current one

const float sphereSolidAngle = 12.5663706;
const float thinOpticalDepth = 1e-3; // below it exp(-x) is replaced by 1 - x

// A view ray clipped to the medium. Lengths are along the ray.
struct ViewRay
{
  vec2 plane;            // intersection with the plane at depth 1 (parallel: at any depth)
  vec3 start;
  vec3 direction;        // unit vector
  float lengthPerDepth;  // length per unit of eye depth
  float begin;           // length at which the ray enters the medium
  float end;             // length at which the ray ends or leaves the medium
  float pathLength;      // in the medium: end - begin
  float closestApproach; // positional lights: length of the point closest to the light
  float lightDistance;   // positional lights: distance of the light from that point
  vec2 angles;           // positional lights: angles of begin and end, seen from the light
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
  return value / sphereSolidAngle;
}

//VTK::Penumbra::Medium

ViewRay clipViewRay(vec2 pixel, float eyeDepth)
{
  ViewRay ray;
  ray.plane = pixelToEye.xy * pixel + pixelToEye.zw;
  vec3 direction = vec3(perspective * ray.plane, 1.0);
  ray.lengthPerDepth = length(direction);
  ray.direction = direction / ray.lengthPerDepth;
  ray.start = perspective > 0.5 ? vec3(0.0) : vec3(ray.plane, 0.0);
  vec2 span = clipToMedium(ray.start, ray.direction, eyeDepth * ray.lengthPerDepth);
  ray.begin = span.x;
  ray.end = span.y;
  ray.pathLength = span.y - span.x;
  return ray;
}

//VTK::Penumbra::Light
