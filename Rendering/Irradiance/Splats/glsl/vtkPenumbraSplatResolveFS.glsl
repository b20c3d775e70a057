//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Output: the interpolated occlusion, or the scene color lit by the interpolated irradiance.
uniform sampler2D means;  // rgb: mean of the records, a: sum of their weights
uniform sampler2D colors; // diffuse reflectance of the scene
uniform vec2 pixelSize;
uniform float light;      // 1: irradiance; 0: occlusion
uniform float strength;   // scales irradiance

void main()
{
  vec2 coordinates = gl_FragCoord.xy * pixelSize;
  vec3 mean = texture(means, coordinates).rgb;
  vec4 color = texture(colors, coordinates);
  gl_FragData[0] = light > 0.5 ? vec4(color.rgb * strength * mean, color.a) : vec4(min(mean, 1.0), 1.0);
}
