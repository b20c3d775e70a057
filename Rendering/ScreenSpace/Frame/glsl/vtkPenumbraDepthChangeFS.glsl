//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Keeps the pixels whose depth is no longer the remembered one; a query counts them.
//VTK::Penumbra::ViewLib
uniform sampler2D depthBuffer;
uniform sampler2D eyeDepths;

// Two compilations of one formula may round differently.
const float rounding = 1e-6;

void main()
{
  vec2 at = gl_FragCoord.xy * pixelSize;
  float now = eyeDepthOfBuffer(texture(depthBuffer, at).r);
  float before = texture(eyeDepths, at).r;
  if (abs(now - before) <= rounding * before)
  {
    discard;
  }
  gl_FragData[0] = vec4(1.0);
}
