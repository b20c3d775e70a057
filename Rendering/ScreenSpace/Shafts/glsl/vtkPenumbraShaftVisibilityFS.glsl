//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lit fraction of every view ray for each light of a group, weighted by in-scattering. The output
// may have one texel per block of pixels. rgb: one fraction per light, a: eye depth.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::ShaftLib
uniform sampler2D eyeDepths;
uniform int referenceChannel; // its lit fractions stand for those of the other channels

//VTK::Penumbra::Estimator

void main()
{
  vec2 pixel = gl_FragCoord.xy;
  float eyeDepth = texture(eyeDepths, pixel * pixelSize).r;
  selectChannel(referenceChannel);
  vec3 lit = vec3(0.0);
  int i = 0;
  do
  {
    light = lights[i];
    vec3 component = vec3(equal(ivec3(0, 1, 2), ivec3(i)));
    lit += component * estimateLitFraction(makeViewRay(pixel, eyeDepth), pixel, eyeDepth);
    ++i;
  } while (i < lightCount);
  gl_FragData[0] = vec4(lit, eyeDepth);
}
