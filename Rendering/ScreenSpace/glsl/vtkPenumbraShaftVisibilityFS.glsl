//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Which part of every view ray is lit by one light, weighted by what it scatters. The picture may be
// one pixel of each block of the scene's. r: share, g: eye depth.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::ShaftLib
uniform sampler2D eyeDepths;

//VTK::Penumbra::Estimator

void main()
{
  vec2 pixel = gl_FragCoord.xy;
  float eyeDepth = texture(eyeDepths, pixel * pixelSize).r;
  float lit = litShareOf(sightThrough(pixel, eyeDepth), pixel, eyeDepth);
  gl_FragData[0] = vec4(lit, eyeDepth, 0.0, 1.0);
}
