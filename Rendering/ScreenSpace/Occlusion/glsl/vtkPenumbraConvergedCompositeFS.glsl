//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Factor that applies the occlusion of a converged frame to the target. Pixels whose depth differs
// from the stored one are discarded; an occlusion query counts the others.
uniform sampler2D depthBuffer;
uniform sampler2D convergedFrame; // r: depth, g: factor
uniform vec2 offset;          // from pixels of the target to those of the converged frame
uniform vec2 targetPixelSize; // 1 / size of the target
uniform vec2 pixelSize;       // 1 / size of the converged frame

void main()
{
  vec2 stored = texture(convergedFrame, (gl_FragCoord.xy + offset) * pixelSize).rg;
  if (texture(depthBuffer, gl_FragCoord.xy * targetPixelSize).r != stored.r)
  {
    discard;
  }
  gl_FragData[0] = vec4(stored.g);
}
