//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Emission at the center pixel of each block [Shafts 13.5]: that of the sky (white, or the image
// behind the scene) and of the chosen emitters. Occluders are black, or keep a fraction of their
// color.
uniform sampler2D depthBuffer;
uniform sampler2D backgroundImage; // behind the scene, used if the delegate does not draw it
uniform sampler2D emitters;        // one texel per block; a: 1 where an emitter is visible
uniform vec2 pixelSize;            // 1 / size of the scene image
uniform vec2 texelSize;            // 1 / number of blocks
uniform float hasEmitters;         // 1: there are emitters
uniform vec4 pixelToBackground;    // xy * pixel + zw: texture coordinates of backgroundImage
uniform float blockSize;           // pixels per side
uniform float background;          // 1: the delegate draws the background
uniform vec2 skyEmission;          // weights of white and of the background image
uniform float surfaceEmission;     // fraction of their color that occluders keep
//VTK::Penumbra::SceneColor

void main()
{
  vec2 pixel = blockSize * floor(gl_FragCoord.xy) + floor(0.5 * blockSize) + 0.5;
  bool empty = texture(depthBuffer, pixel * pixelSize).r >= 1.0;
  vec3 scene = sceneColorAt(pixel).rgb;
  vec3 sky = background > 0.5
    ? scene
    : texture(backgroundImage, pixelToBackground.xy * pixel + pixelToBackground.zw).rgb;
  vec3 emitted = empty ? vec3(skyEmission.x) + skyEmission.y * sky : surfaceEmission * scene;
  vec4 emitter = texture(emitters, gl_FragCoord.xy * texelSize);
  gl_FragData[0] = vec4(mix(emitted, emitter.rgb, hasEmitters * emitter.a), 1.0);
}
