//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The mean of what the records said; of occlusion that itself, of light the colour that it gives to the
// scene's own.
uniform sampler2D sums;   // rgb: weighted values, a: weights
uniform sampler2D colors; // of the scene: what of the light it throws back
uniform vec2 pixelSize;
uniform float light;      // 1: light; 0: occlusion
uniform float strength;   // of light

void main()
{
  vec2 at = gl_FragCoord.xy * pixelSize;
  vec4 sum = texture(sums, at);
  vec3 mean = sum.a > 0.0 ? sum.rgb / sum.a : vec3(0.0);
  vec4 color = texture(colors, at);
  gl_FragData[0] = light > 0.5 ? vec4(color.rgb * strength * mean, color.a) : vec4(min(mean, 1.0), 1.0);
}
