//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Of every block of pixels the eye depth of the one in the middle.
uniform sampler2D eyeDepths;
uniform vec2 pixelSize; // 1 / size of the picture
uniform float block;    // pixels a side

void main()
{
  vec2 pixel = block * floor(gl_FragCoord.xy) + floor(0.5 * block) + 0.5;
  gl_FragData[0] = vec4(texture(eyeDepths, pixel * pixelSize).r);
}
