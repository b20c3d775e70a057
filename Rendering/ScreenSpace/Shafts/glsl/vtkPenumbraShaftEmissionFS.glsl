//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What glows in one pixel of each block of the scene's picture [Shafts 13.5]: the sky, white or as the
// picture behind the scene shows it, chosen emitters; occluders are black, or of lower contrast.
uniform sampler2D depthBuffer;
uniform sampler2D behind;    // the picture behind the scene, where the delegate does not draw it
uniform sampler2D emitters;  // of the blocks; a: 1 where one is seen
uniform vec2 pixelSize;      // 1 / size of the scene's picture
uniform vec2 texelSize;      // 1 / number of blocks
uniform float glowing;       // 1: there are emitters
uniform vec4 toBehind;       // xy * pixel + zw: there
uniform float block;         // pixels a side
uniform float background;    // 1: the delegate draws it
uniform vec2 sky;            // how much of white, how much of the picture behind glows
uniform float surfaceEmission;   // what is left of an occluder's colour
//VTK::Penumbra::Picture

void main()
{
  vec2 pixel = block * floor(gl_FragCoord.xy) + floor(0.5 * block) + 0.5;
  bool empty = texture(depthBuffer, pixel * pixelSize).r >= 1.0;
  vec3 scene = pictureAt(pixel).rgb;
  vec3 beyond = background > 0.5 ? scene : texture(behind, toBehind.xy * pixel + toBehind.zw).rgb;
  vec3 glow = empty ? vec3(sky.x) + sky.y * beyond : surfaceEmission * scene;
  vec4 emitter = texture(emitters, gl_FragCoord.xy * texelSize);
  gl_FragData[0] = vec4(mix(glow, emitter.rgb, glowing * emitter.a), 1.0);
}
