//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Draws the scene image, darkened by occlusion, with its depth.
//VTK::Penumbra::ApplyOcclusionLib
uniform sampler2D colors;
uniform sampler2D depthBuffer;
uniform sampler2D occlusions;
uniform vec2 pixelSize;   // 1 / size of the scene image
uniform vec2 offset;      // from pixels of the target to those of the scene image
uniform vec2 toTargetDepth; // x * depth + y: from depths of the image to those of the target
uniform float background; // 1: empty pixels are drawn, too; 0: the target keeps them

void main()
{
  vec2 position = (gl_FragCoord.xy + offset) * pixelSize;
  float depth = texture(depthBuffer, position).r;
  vec4 color = texture(colors, position);
  // A skybox has the depth of an empty pixel, but nonzero alpha.
  if (depth >= 1.0 && background < 0.5 && color.a <= 0.0)
  {
    discard;
  }
  float occlusion = depth < 1.0 ? texture(occlusions, position).r : 0.0;
  gl_FragData[0] = vec4(applyOcclusion(color.rgb, occlusion), color.a);
  gl_FragDepth = depth < 1.0 ? toTargetDepth.x * depth + toTargetDepth.y : 1.0;
}
