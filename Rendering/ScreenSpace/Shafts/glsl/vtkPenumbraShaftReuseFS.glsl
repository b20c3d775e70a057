//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Blends the stored medium over an image, as vtkPenumbraShaftBlendFS, at pixels whose depth equals
// the stored one. An occlusion query counts these pixels.
//VTK::Penumbra::ViewLib
uniform sampler2D depthBuffer;
uniform sampler2D eyeDepths;   // the stored depths
uniform sampler2D shafts;      // rgb: in-scattered light, a: transmittance
uniform vec2 shaftsPixelSize;  // 1 / size of shafts
uniform float gain;            // factor on the in-scattered light
uniform vec2 offset;           // from pixels of the target to those of shafts

// Relative tolerance: two compilations of the same formula may round differently.
const float rounding = 1e-6;

void main()
{
  vec2 position = gl_FragCoord.xy * pixelSize;
  float current = eyeDepthOfBuffer(texture(depthBuffer, position).r);
  float stored = texture(eyeDepths, position).r;
  if (abs(current - stored) > rounding * stored)
  {
    discard;
  }
  vec4 medium = texture(shafts, (gl_FragCoord.xy + offset) * shaftsPixelSize);
  gl_FragData[0] = vec4(gain * medium.rgb, 1.0 - medium.a);
}
