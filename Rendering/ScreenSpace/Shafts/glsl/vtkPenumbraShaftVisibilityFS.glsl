//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Which part of every view ray is lit by each of some lights, weighted by what it scatters. The picture
// may be one pixel of each block of the scene's. rgb: shares, a: eye depth.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::ShaftLib
uniform sampler2D eyeDepths;

//VTK::Penumbra::Estimator

void main()
{
  vec2 pixel = gl_FragCoord.xy;
  float eyeDepth = texture(eyeDepths, pixel * pixelSize).r;
  vec3 lit = vec3(0.0);
  for (int i = 0; i < lightCount; ++i)
  {
    light = lights[i];
    vec3 own = vec3(equal(ivec3(0, 1, 2), ivec3(i)));
    lit += own * litShareOf(sightThrough(pixel, eyeDepth), pixel, eyeDepth);
  }
  gl_FragData[0] = vec4(lit, eyeDepth);
}
