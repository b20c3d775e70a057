// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Premultiplied color of the scene image with one sample per pixel; alpha is its coverage.
uniform sampler2D colors;

vec4 sceneColorAt(vec2 pixel)
{
  float coverage = texture(depthBuffer, pixel * pixelSize).r < 1.0 ? 1.0 : background;
  return coverage * vec4(texture(colors, pixel * pixelSize).rgb, 1.0);
}
