//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the records say together, the same as penumbra::Blend::Result(): rgb the mean over the hemisphere,
// a their weight. The inputs are vtkPenumbraSplatFS.glsl's outputs, added up.
uniform sampler2D values;
uniform sampler2D ways;
uniform sampler2D slopes0; // of each channel; those that there are not are 0
uniform sampler2D slopes1;
uniform sampler2D slopes2;
uniform vec2 pixelSize;

void main()
{
  vec2 at = gl_FragCoord.xy * pixelSize;
  vec4 value = texture(values, at);
  vec4 way = texture(ways, at);
  vec3 further = vec3(
    dot(texture(slopes0, at), way), dot(texture(slopes1, at), way), dot(texture(slopes2, at), way));
  vec3 mean = value.a > 0.0 ? (value.rgb + 0.5 * further / value.a) / value.a : vec3(0.0);
  gl_FragData[0] = vec4(max(mean, vec3(0.0)), value.a);
}
