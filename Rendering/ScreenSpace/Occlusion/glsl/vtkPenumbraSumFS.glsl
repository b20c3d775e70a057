//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// New samples, to be added to those of earlier frames by blending.
//VTK::Penumbra::SoundLib
uniform sampler2D estimates;
uniform vec2 pixelSize;
uniform float newSamples;

void main()
{
  float estimate = texture(estimates, gl_FragCoord.xy * pixelSize).r;
  gl_FragData[0] = vec4(soundSamples(estimate, newSamples), 0.0, 1.0);
}
