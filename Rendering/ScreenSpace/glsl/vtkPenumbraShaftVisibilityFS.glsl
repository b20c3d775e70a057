//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Which part of every view ray is lit by one light, weighted by what it scatters. A texel stands for
// the lower left of a block of pixels. r: share, g: eye depth.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::ShaftLib
uniform sampler2D eyeDepths;
uniform float block; // pixels a side

//VTK::Penumbra::Estimator

void main()
{
  vec2 pixel = floor(gl_FragCoord.xy) * block + 0.5;
  float eyeDepth = texture(eyeDepths, pixel * pixelSize).r;
  float lit = litShareOf(sightThrough(pixel, eyeDepth), pixel, eyeDepth);
  gl_FragData[0] = vec4(lit, eyeDepth, 0.0, 1.0);
}
