//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Output of the medium only, to be blended over the image behind it: rgb is the in-scattered light,
// alpha is the opacity of the medium.
uniform sampler2D shafts; // rgb: in-scattered light, a: transmittance
uniform vec2 pixelSize;   // 1 / size of shafts
uniform float gain;       // factor on the in-scattered light
uniform vec2 offset;      // from pixels of the target to those of shafts

void main()
{
  vec4 medium = texture(shafts, (gl_FragCoord.xy + offset) * pixelSize);
  gl_FragData[0] = vec4(gain * medium.rgb, 1.0 - medium.a);
}
