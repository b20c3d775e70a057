//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Weighted average of the records, equal to penumbra::RecordInterpolator::Result(). rgb: mean over
// the hemisphere, a: sum of the weights. The inputs are the blended outputs of
// vtkPenumbraSplatFS.glsl.
uniform sampler2D values;
uniform sampler2D offsets;
uniform sampler2D gradients0; // one per channel; unused ones do not affect the used channels
uniform sampler2D gradients1;
uniform sampler2D gradients2;
uniform vec2 pixelSize;

void main()
{
  vec2 coordinates = gl_FragCoord.xy * pixelSize;
  vec4 value = texture(values, coordinates);
  vec4 offset = texture(offsets, coordinates);
  vec3 change = vec3(
    dot(texture(gradients0, coordinates), offset),
    dot(texture(gradients1, coordinates), offset),
    dot(texture(gradients2, coordinates), offset));
  vec3 mean = value.a > 0.0 ? (value.rgb + 0.5 * change / value.a) / value.a : vec3(0.0);
  gl_FragData[0] = vec4(max(mean, vec3(0.0)), value.a);
}
