//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The mean of what the records said; of occlusion that itself, of light the colour that it gives to the
// scene's own.
uniform sampler2D means;  // rgb: of the records, a: their weight
uniform sampler2D colors; // of the scene: what of the light it throws back
uniform vec2 pixelSize;
uniform float light;      // 1: light; 0: occlusion
uniform float strength;   // of light

void main()
{
  vec2 at = gl_FragCoord.xy * pixelSize;
  vec3 mean = texture(means, at).rgb;
  vec4 color = texture(colors, at);
  gl_FragData[0] = light > 0.5 ? vec4(color.rgb * strength * mean, color.a) : vec4(min(mean, 1.0), 1.0);
}
