//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Writes sum and number of new samples, which blending adds to those of earlier frames.
//VTK::Penumbra::FiniteValuesLib
uniform sampler2D estimates;
uniform vec2 pixelSize;
uniform float newSamples;

void main()
{
  float estimate = texture(estimates, gl_FragCoord.xy * pixelSize).r;
  gl_FragData[0] = vec4(finiteSamples(estimate, newSamples), 0.0, 1.0);
}
