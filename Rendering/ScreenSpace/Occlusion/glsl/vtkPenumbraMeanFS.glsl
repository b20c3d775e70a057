//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Computes the mean of all samples of a pixel.
uniform sampler2D values; // r: sum, g: number of samples
uniform vec2 pixelSize;

void main()
{
  vec2 value = texture(values, gl_FragCoord.xy * pixelSize).rg;
  gl_FragData[0] = vec4(min(value.r / max(value.g, 1e-6), 1.0));
}
