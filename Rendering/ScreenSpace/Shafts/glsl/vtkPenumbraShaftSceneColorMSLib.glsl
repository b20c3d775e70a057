// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The scene's picture with several samples a pixel; alpha is the share that they cover.
uniform sampler2DMS colors;
uniform sampler2DMS depthSamples;
uniform int sampleCount;

vec4 pictureAt(vec2 pixel)
{
  vec4 sum = vec4(0.0);
  for (int i = 0; i < sampleCount; ++i)
  {
    float covers = texelFetch(depthSamples, ivec2(pixel), i).r < 1.0 ? 1.0 : background;
    sum += covers * vec4(texelFetch(colors, ivec2(pixel), i).rgb, 1.0);
  }
  return sum / float(sampleCount);
}
