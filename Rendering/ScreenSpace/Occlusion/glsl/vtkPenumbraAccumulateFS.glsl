//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Adds new samples to those of earlier frames when the view has not moved [TSSAO eq. 4-5].
//VTK::Penumbra::FiniteValuesLib
uniform sampler2D estimates;
uniform sampler2D history; // r: sum, g: number of samples
uniform vec2 pixelSize;
uniform float newSamples;
uniform float weightCap;   // upper bound of the weight of the history in this frame, in samples

void main()
{
  vec2 at = gl_FragCoord.xy * pixelSize;
  vec2 sum = finiteHistory(texture(history, at).rg);
  sum *= min(1.0, weightCap / max(sum.g, 1e-6));
  gl_FragData[0] = vec4(sum + finiteSamples(texture(estimates, at).r, newSamples), 0.0, 1.0);
}
