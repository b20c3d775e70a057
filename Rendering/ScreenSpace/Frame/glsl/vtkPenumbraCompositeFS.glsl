//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The scene, darkened, with its own depth.
//VTK::Penumbra::ApplyOcclusionLib
uniform sampler2D colors;
uniform sampler2D depthBuffer;
uniform sampler2D occlusions;
uniform vec2 pixelSize;   // of the scene's picture
uniform vec2 offset;      // from pixels of the target to those of the scene's picture
uniform vec2 toTargetDepth; // a depth of the picture times x plus y is the target's
uniform float background; // 1: pixels without a surface are the scene's, too; 0: they stay

void main()
{
  vec2 at = (gl_FragCoord.xy + offset) * pixelSize;
  float depth = texture(depthBuffer, at).r;
  vec4 color = texture(colors, at);
  // A skybox has the depth of an empty pixel, but a color.
  if (depth >= 1.0 && background < 0.5 && color.a <= 0.0)
  {
    discard;
  }
  float occlusion = depth < 1.0 ? texture(occlusions, at).r : 0.0;
  gl_FragData[0] = vec4(applyOcclusion(color.rgb, occlusion), color.a);
  gl_FragDepth = depth < 1.0 ? toTargetDepth.x * depth + toTargetDepth.y : 1.0;
}
