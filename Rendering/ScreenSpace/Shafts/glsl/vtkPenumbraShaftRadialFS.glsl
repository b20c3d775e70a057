//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lit fraction of a view ray, estimated by radial blur: the mean emission on the screen segment
// from the pixel to the light [Shafts eq. 3 and 4], or one of several chained passes, each of which
// averages the result of the previous one (13.8). With geometric spacing the steps add up as
// exponents, so that the passes together are one long loop. Departures from the paper:
// - Samples are divided by their number, and all of them are weighted.
// - Decay applies per 1/64 of the path.
// - Evenly spaced samples end at the image edge, others within a guard band.
// - Shadows fade out when the light is behind the camera.
//VTK::Penumbra::ViewLib
uniform sampler2D emission;
uniform sampler2D eyeDepths;
uniform vec4 light;         // position (w = 1), or unit direction toward the light (w = 0)
uniform int steps;
uniform float density;      // divides the length of the evenly spaced path
uniform float evenSpacing;  // 1: samples are evenly spaced, 0: geometrically
uniform vec2 spacingGrowth; // geometric: logarithm of the factor per step; the step while that is 0
uniform float firstStep;    // in steps of the long loop
uniform float stepStride;   // between samples, in steps of the long loop
uniform float decay;        // per sample
uniform float weight;
uniform float isLastPass;   // 1: the last of the chained passes

vec2 pathToLight(vec2 pixel, float planeFactor)
{
  return pixelOffsetOnPlane(light.xy - planeOfPixel(pixel) * planeFactor);
}

// Step of a path that ends at the light or at the image edge, as a fraction of `path`.
float evenStride(vec2 pixel, vec2 path, float planeFactor)
{
  vec2 room = mix(pixel, 1.0 / pixelSize - pixel, step(0.0, path));
  vec2 edge = room / max(abs(path), 1e-9);
  return min(min(edge.x, edge.y), 1.0 / max(planeFactor, 1e-6)) / (density * float(steps));
}

float geometricPosition(float exponent, float planeFactor)
{
  float logFactor = spacingGrowth.x * exponent;
  return abs(spacingGrowth.x) < 1e-5 ? spacingGrowth.y * exponent
                                     : (1.0 - exp(logFactor)) / planeFactor;
}

void main()
{
  vec2 pixel = gl_FragCoord.xy;
  float planeFactor = perspective > 0.5 ? light.z : light.w;
  vec2 path = pathToLight(pixel, planeFactor);
  float stride = evenStride(pixel, path, planeFactor);
  vec3 sum = vec3(0.0);
  float sampleWeight = 1.0;
  for (int i = 0; i < steps; ++i)
  {
    float exponent = stepStride * float(i) + firstStep;
    float position =
      evenSpacing > 0.5 ? stride * exponent : geometricPosition(exponent, planeFactor);
    sum += sampleWeight * texture(emission, (pixel + position * path) * pixelSize).rgb;
    sampleWeight *= decay;
  }
  vec3 mean = sum / float(steps);
  float inFront = smoothstep(-0.2, 0.2, light.z / length(light.xyz));
  vec3 lit = isLastPass > 0.5 ? mix(vec3(1.0), weight * mean, inFront) : mean;
  gl_FragData[0] = vec4(lit, texture(eyeDepths, pixel * pixelSize).r);
}
