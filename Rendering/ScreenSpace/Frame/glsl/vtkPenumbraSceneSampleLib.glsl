// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The scene image with one sample per pixel. Needs ViewLib.
uniform sampler2D colors;
uniform sampler2D depthBuffer;

vec4 sampleColor(vec2 pixel)
{
  return texture(colors, pixel * pixelSize);
}

float sampleDepth(vec2 pixel)
{
  return texture(depthBuffer, pixel * pixelSize).r;
}

// Returns the texture coordinates of the pixel that shows the surface of the sample.
vec3 surfacePosition(vec2 pixel, float depth)
{
  return vec3(pixel * pixelSize, 0.0);
}
