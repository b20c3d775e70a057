//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A sample of each pixel of the scene, seen through the medium in front of its surface: color *
// transmittance + in-scattered light, to be blended over the target. Alpha is the opacity of
// surfaces and medium together.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::SceneSample
uniform sampler2D shafts;  // rgb: in-scattered light, a: transmittance
uniform float gain;        // factor on the in-scattered light
uniform vec2 offset;       // from pixels of the target to those of the scene image
uniform float background;  // 1: empty pixels belong to the scene image; 0: the target shows through
uniform vec3 extinctionRatios; // of the channels to the one whose transmittance is stored
uniform int part;              // 0: gray; colored: 1: factor on the target, 2: what is added to it

void main()
{
  vec2 pixel = gl_FragCoord.xy + offset;
  float depth = sampleDepth(pixel);
  vec4 scene = depth < 1.0 || background > 0.5 ? vec4(sampleColor(pixel).rgb, 1.0) : vec4(0.0);
  vec4 medium = texture(shafts, surfacePosition(pixel, depth).xy);
  vec3 transmittance = part > 0 ? pow(vec3(medium.a), extinctionRatios) : vec3(medium.a);
  vec3 color = scene.rgb * transmittance + gain * medium.rgb;
  vec4 behind = (1.0 - scene.a) * vec4(transmittance, medium.a);
  gl_FragData[0] = part == 1 ? behind : vec4(color, 1.0 - behind.a);
  gl_FragDepth = depth;
}
