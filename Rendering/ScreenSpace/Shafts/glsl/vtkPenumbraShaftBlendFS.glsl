//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The medium alone, to be blended over the picture that lies behind it: scattered light, and as alpha
// what the medium hides.
uniform sampler2D shafts; // rgb: scattered light, a: transmittance
uniform vec2 pixelSize;
uniform float gain;       // of scattered light
uniform vec2 offset;      // from pixels of the target to those of the shafts

void main()
{
  vec4 fog = texture(shafts, (gl_FragCoord.xy + offset) * pixelSize);
  gl_FragData[0] = vec4(gain * fog.rgb, 1.0 - fog.a);
}
