//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The medium over a picture that was drawn before, as vtkPenumbraShaftBlendFS, wherever depths are those
// that are known; a query counts these pixels.
//VTK::Penumbra::ViewLib
uniform sampler2D depthBuffer;
uniform sampler2D eyeDepths;
uniform sampler2D shafts;      // rgb: scattered light, a: transmittance
uniform vec2 shaftsPixelSize;
uniform float gain;            // of scattered light
uniform vec2 offset;           // from pixels of the target to those of the shafts

// Two compilations of one formula may round differently.
const float rounding = 1e-6;

void main()
{
  vec2 at = gl_FragCoord.xy * pixelSize;
  float now = eyeDepthOfBuffer(texture(depthBuffer, at).r);
  float known = texture(eyeDepths, at).r;
  if (abs(now - known) > rounding * known)
  {
    discard;
  }
  vec4 fog = texture(shafts, (gl_FragCoord.xy + offset) * shaftsPixelSize);
  gl_FragData[0] = vec4(gain * fog.rgb, 1.0 - fog.a);
}
