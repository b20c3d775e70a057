//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// New samples join those of earlier frames where nothing moved [TSSAO eq. 4-5].
//VTK::Penumbra::SoundLib
uniform sampler2D estimates;
uniform sampler2D history; // r: sum, g: number of samples
uniform vec2 pixelSize;
uniform float newSamples;
uniform float weightCap;   // no more of the history counts in this frame

void main()
{
  vec2 at = gl_FragCoord.xy * pixelSize;
  vec2 kept = soundHistory(texture(history, at).rg);
  kept *= min(1.0, weightCap / max(kept.g, 1e-6));
  gl_FragData[0] = vec4(kept + soundSamples(texture(estimates, at).r, newSamples), 0.0, 1.0);
}
