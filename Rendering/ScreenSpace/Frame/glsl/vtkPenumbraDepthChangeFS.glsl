//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Discards pixels whose depth equals the previous one. An occlusion query counts the others.
//VTK::Penumbra::ViewLib
uniform sampler2D depthBuffer;
uniform sampler2D eyeDepths;

// Relative tolerance: two compilations of the same formula may round differently.
const float rounding = 1e-6;

void main()
{
  vec2 position = gl_FragCoord.xy * pixelSize;
  float current = eyeDepthOfBuffer(texture(depthBuffer, position).r);
  float previous = texture(eyeDepths, position).r;
  if (abs(current - previous) <= rounding * previous)
  {
    discard;
  }
  gl_FragData[0] = vec4(1.0);
}
