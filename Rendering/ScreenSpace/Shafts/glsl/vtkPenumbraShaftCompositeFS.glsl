//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The picture behind its medium: colour * transmittance + scattered light, to be blended over what is
// there: alpha is what surfaces and medium hide of it.
uniform sampler2D shafts;  // rgb: scattered light, a: transmittance
uniform sampler2D depthBuffer;
uniform vec2 pixelSize;
uniform float gain;        // of scattered light
uniform vec2 offset;       // from pixels of the target to those of the scene's picture
uniform float background;  // 1: pixels without a surface are the picture's, too; 0: they stay
//VTK::Penumbra::Picture

void main()
{
  vec2 pixel = gl_FragCoord.xy + offset;
  vec4 seen = pictureAt(pixel);
  vec4 fog = texture(shafts, pixel * pixelSize);
  gl_FragData[0] = vec4(seen.rgb * fog.a + gain * fog.rgb, 1.0 - (1.0 - seen.a) * fog.a);
  gl_FragDepth = texture(depthBuffer, pixel * pixelSize).r;
}
