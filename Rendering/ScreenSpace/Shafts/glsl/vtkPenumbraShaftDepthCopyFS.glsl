//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Downsamples the depth buffer to the center pixel of each block. Depths are moved back by
// depthOffset, so that geometry that is rendered again at the same depth passes the depth test.
uniform sampler2D depthBuffer;
uniform vec2 pixelSize;  // 1 / size of the image
uniform float blockSize; // pixels per side

const float depthOffset = 1e-5; // in depth buffer units

void main()
{
  vec2 pixel = blockSize * floor(gl_FragCoord.xy) + floor(0.5 * blockSize) + 0.5;
  gl_FragData[0] = vec4(0.0);
  gl_FragDepth = min(texture(depthBuffer, pixel * pixelSize).r + depthOffset, 1.0);
}
