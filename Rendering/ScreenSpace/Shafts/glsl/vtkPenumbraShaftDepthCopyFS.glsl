//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Of every block of pixels the depth of the one in the middle, as depth; a little farther, so that what
// is drawn once more at the same depth is seen.
uniform sampler2D depthBuffer;
uniform vec2 pixelSize; // 1 / size of the picture
uniform float block;    // pixels a side

const float farther = 1e-5;

void main()
{
  vec2 pixel = block * floor(gl_FragCoord.xy) + floor(0.5 * block) + 0.5;
  gl_FragData[0] = vec4(0.0);
  gl_FragDepth = min(texture(depthBuffer, pixel * pixelSize).r + farther, 1.0);
}
