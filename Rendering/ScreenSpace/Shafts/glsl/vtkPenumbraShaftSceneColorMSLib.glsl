// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The scene image with several samples per pixel; colors are premultiplied, alpha is the coverage.
uniform sampler2DMS colors;
uniform sampler2DMS depthSamples;
uniform int sampleCount;

float sampleDepth(vec2 pixel, int i)
{
  return texelFetch(depthSamples, ivec2(pixel), i).r;
}

vec4 sampleColor(vec2 pixel, int i)
{
  float coverage = sampleDepth(pixel, i) < 1.0 ? 1.0 : background;
  return coverage * vec4(texelFetch(colors, ivec2(pixel), i).rgb, 1.0);
}

vec4 sceneColorAt(vec2 pixel)
{
  vec4 sum = vec4(0.0);
  for (int i = 0; i < sampleCount; ++i)
  {
    sum += sampleColor(pixel, i);
  }
  return sum / float(sampleCount);
}
