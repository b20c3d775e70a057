// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The scene's picture with one sample a pixel; alpha is the share that it covers.
uniform sampler2D colors;

vec4 pictureAt(vec2 pixel)
{
  float covers = texture(depthBuffer, pixel * pixelSize).r < 1.0 ? 1.0 : background;
  return covers * vec4(texture(colors, pixel * pixelSize).rgb, 1.0);
}
