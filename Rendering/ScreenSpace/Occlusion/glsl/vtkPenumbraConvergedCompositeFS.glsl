//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What a picture is multiplied by, wherever its depth is the one that is remembered; a query counts
// these pixels.
uniform sampler2D depthBuffer;
uniform sampler2D memory;     // r: depth, g: factor
uniform vec2 offset;          // from pixels of the target to those of the memory
uniform vec2 targetPixelSize; // 1 / size of the target
uniform vec2 pixelSize;       // 1 / size of the memory

void main()
{
  vec2 known = texture(memory, (gl_FragCoord.xy + offset) * pixelSize).rg;
  if (texture(depthBuffer, gl_FragCoord.xy * targetPixelSize).r != known.r)
  {
    discard;
  }
  gl_FragData[0] = vec4(known.g);
}
