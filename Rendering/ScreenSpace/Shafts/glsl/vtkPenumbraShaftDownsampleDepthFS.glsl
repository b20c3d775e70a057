//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Downsamples eye depth to the center pixel of each block.
uniform sampler2D eyeDepths;
uniform vec2 pixelSize;  // 1 / size of the image
uniform float blockSize; // pixels per side

void main()
{
  vec2 pixel = blockSize * floor(gl_FragCoord.xy) + floor(0.5 * blockSize) + 0.5;
  gl_FragData[0] = vec4(texture(eyeDepths, pixel * pixelSize).r);
}
