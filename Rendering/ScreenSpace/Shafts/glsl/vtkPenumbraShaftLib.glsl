// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A medium and its lights: single scattering along view rays toward the eye [Shafts
// eq. 1]. Coordinates are eye coordinates with z along the view axis. The library of the light type
// follows at the end. Its CDF maps lengths along a view ray to [0, 1] so that equal intervals
// scatter equal (directional light) or similar (positional light) amounts of light while the ray is
// lit. Loops over lights and steps test their number after each one: some drivers execute the body of a
// loop once more, without effect, if the condition comes first.
uniform vec4 lights[3];     // positions (w = 1), or unit directions toward the lights (w = 0)
uniform int lightCount;       // at least 1
uniform vec3 coefficients[3]; // per color channel and unit of length: scattering, extinction, Rayleigh
uniform int phase;          // vtkPenumbraLightShaftPass::Phases
uniform float asymmetry;    // mean cosine of HENYEY_GREENSTEIN

vec4 light = vec4(0.0);     // the current one
float scattering;           // coefficients of the current channel
float extinction;
float rayleigh;

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
  float column;          // integral of the relative density over that path
  float density;         // relative density at begin
  float decay;           // of the density along the ray, per unit of length
  float closestApproach; // positional lights: length of the point closest to the light
  float lightDistance;   // positional lights: distance of the light from that point
  vec2 angles;           // positional lights: angles of begin and end, seen from the light
};

#define NUMBER float
#define FUNCTION float
//VTK::Penumbra::PhaseFunctions

void selectChannel(int channel)
{
  scattering = coefficients[channel].x;
  extinction = coefficients[channel].y;
  rayleigh = coefficients[channel].z;
}

// Light that is scattered toward the eye, per unit of length, of the amount `arriving`.
float scatteredLight(float arriving, float cosine)
{
  float mie = arriving * scattering * phaseFunctionOf(phase, cosine, asymmetry);
  return rayleigh > 0.0 ? mie + arriving * rayleigh * rayleighPhase(cosine) : mie;
}

//VTK::Penumbra::Medium

//VTK::Penumbra::Density

float columnOfRay(ViewRay ray, float span)
{
  return columnAlong(ray.density, ray.decay, span);
}

// Column of the path from a point in the medium to a light at distance `lightDistance`.
float columnToLight(vec3 point, vec3 toLight, float lightDistance)
{
  return columnAlong(
    densityAt(point), decayAlong(toLight), lengthInMedium(point, toLight, lightDistance));
}

ViewRay clipViewRay(vec2 pixel, float eyeDepth)
{
  ViewRay ray;
  ray.plane = planeOfPixel(pixel);
  vec3 direction = vec3(perspective * ray.plane, 1.0);
  ray.lengthPerDepth = length(direction);
  ray.direction = direction / ray.lengthPerDepth;
  ray.start = perspective > 0.5 ? vec3(0.0) : vec3(ray.plane, 0.0);
  vec2 span = clipToMedium(ray.start, ray.direction, eyeDepth * ray.lengthPerDepth);
  ray.begin = span.x;
  ray.end = span.y;
  ray.pathLength = span.y - span.x;
  ray.density = densityAt(ray.start + ray.begin * ray.direction);
  ray.decay = decayAlong(ray.direction);
  ray.column = columnOfRay(ray, ray.pathLength);
  return ray;
}

//VTK::Penumbra::Light
