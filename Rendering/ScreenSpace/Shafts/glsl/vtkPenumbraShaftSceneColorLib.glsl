// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The scene image with one sample per pixel; colors are premultiplied, alpha is the coverage.
uniform sampler2D colors;
const int sampleCount = 1;

float sampleDepth(vec2 pixel, int i)
{
  return texture(depthBuffer, pixel * pixelSize).r;
}

vec4 sampleColor(vec2 pixel, int i)
{
  float coverage = sampleDepth(pixel, i) < 1.0 ? 1.0 : background;
  return coverage * vec4(texture(colors, pixel * pixelSize).rgb, 1.0);
}

vec4 sceneColorAt(vec2 pixel)
{
  return sampleColor(pixel, 0);
}
