//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Which part of a view ray is lit, as the paper guesses it: the mean of what glows on the screen
// segment from the pixel to the light [Shafts eq. 3 and 4]; or one of its chained passes, each of which
// takes the mean of the one before (13.8). At geometric distances from the light steps add up as
// exponents, so that the passes together are one long loop. Departures: samples are divided by n and
// all weighted; decay counts for each 1/64 of the way; evenly spaced ways end at the picture's border,
// others within a guard band; behind the camera shadows fade.
//VTK::Penumbra::ViewLib
uniform sampler2D glows;
uniform sampler2D eyeDepths;
uniform vec4 light;       // where it is (w = 1), or the unit direction towards it (w = 0)
uniform int steps;
uniform float density;    // the even way is this much shorter
uniform float evenly;     // 1: the same distance between samples, 0: geometric
uniform vec2 growth;      // geometric: logarithm of the factor of a step; the step where that is 0
uniform float first;      // in steps of the long loop
uniform float leap;       // between samples, in these steps
uniform float decay;      // for each sample
uniform float weight;
uniform float last;       // 1: the last pass

vec2 wayToLight(vec2 pixel, float turn)
{
  vec2 plane = pixelToEye.xy * pixel + pixelToEye.zw;
  return (light.xy - plane * turn) / pixelToEye.xy;
}

// Up to where the way from a pixel goes: to the light, or to the picture's border.
float evenStride(vec2 pixel, vec2 way, float turn)
{
  vec2 room = mix(pixel, 1.0 / pixelSize - pixel, step(0.0, way));
  vec2 border = room / max(abs(way), 1e-9);
  return min(min(border.x, border.y), 1.0 / max(turn, 1e-6)) / (density * float(steps));
}

float geometricWay(float exponent, float turn)
{
  float shrunk = growth.x * exponent;
  return abs(growth.x) < 1e-5 ? growth.y * exponent : (1.0 - exp(shrunk)) / turn;
}

void main()
{
  vec2 pixel = gl_FragCoord.xy;
  float turn = perspective > 0.5 ? light.z : light.w;
  vec2 way = wayToLight(pixel, turn);
  float stride = evenStride(pixel, way, turn);
  vec3 sum = vec3(0.0);
  float share = 1.0;
  for (int i = 0; i < steps; ++i)
  {
    float exponent = leap * float(i) + first;
    float gone = evenly > 0.5 ? stride * exponent : geometricWay(exponent, turn);
    sum += share * texture(glows, (pixel + gone * way) * pixelSize).rgb;
    share *= decay;
  }
  vec3 mean = sum / float(steps);
  float before = smoothstep(-0.2, 0.2, light.z / length(light.xyz));
  vec3 lit = last > 0.5 ? mix(vec3(1.0), weight * mean, before) : mean;
  gl_FragData[0] = vec4(lit, texture(eyeDepths, pixel * pixelSize).r);
}
