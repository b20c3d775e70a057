// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Which part of a view ray is lit, as the paper guesses it: the mean of what glows on the screen
// segment from the pixel to the light [Shafts eq. 3 and 4]. Departures: samples are divided by n and
// all weighted; decay counts for each 1/64 of the way; where the light nears the camera plane the
// segment ends at the picture's border, and behind it shadows fade.
uniform int steps;
uniform float weight;
uniform float decay;
uniform float density;     // the segment is this much shorter
uniform float surfaceGlow; // what an occluder lets through: 0 black, more: lower contrast

float litShareOf(Sight sight, vec2 pixel, float eyeDepth)
{
  float turn = perspective > 0.5 ? light.z : light.w;
  vec2 way = (light.xy - sight.plane * turn) / pixelToEye.xy;
  vec2 room = mix(pixel, 1.0 / pixelSize - pixel, step(0.0, way));
  vec2 border = room / max(abs(way), 1e-9);
  float stride = min(min(border.x, border.y), 1.0 / max(turn, 1e-6)) / (density * float(steps));
  float sum = 0.0;
  for (int i = 0; i < steps; ++i)
  {
    float depth = texture(eyeDepths, (pixel + stride * (float(i) + 0.5) * way) * pixelSize).r;
    float glow = depth < 0.5 * farAway ? surfaceGlow : 1.0;
    sum += pow(decay, 64.0 * float(i) / float(steps)) * glow;
  }
  float before = smoothstep(-0.2, 0.2, light.z / length(light.xyz));
  return mix(1.0, weight * sum / float(steps), before);
}
