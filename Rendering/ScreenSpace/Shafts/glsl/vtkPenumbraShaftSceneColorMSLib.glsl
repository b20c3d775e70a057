// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Premultiplied mean color of the scene image with several samples per pixel; alpha is its
// coverage.
uniform sampler2DMS colors;
uniform sampler2DMS depthSamples;
uniform int sampleCount;

vec4 sceneColorAt(vec2 pixel)
{
  vec4 sum = vec4(0.0);
  for (int i = 0; i < sampleCount; ++i)
  {
    float coverage = texelFetch(depthSamples, ivec2(pixel), i).r < 1.0 ? 1.0 : background;
    sum += coverage * vec4(texelFetch(colors, ivec2(pixel), i).rgb, 1.0);
  }
  return sum / float(sampleCount);
}
