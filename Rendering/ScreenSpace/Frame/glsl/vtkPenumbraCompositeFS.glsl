//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Draws a sample of each pixel of the scene image, darkened by the occlusion of its surface, with
// its depth.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::SceneSample
//VTK::Penumbra::ApplyOcclusionLib
uniform sampler2D occlusions;
uniform vec2 offset;      // from pixels of the target to those of the scene image
uniform vec2 toTargetDepth; // x * depth + y: from depths of the image to those of the target
uniform float background; // 1: empty samples are drawn, too; 0: the target keeps them

void main()
{
  vec2 pixel = gl_FragCoord.xy + offset;
  float depth = sampleDepth(pixel);
  vec4 color = sampleColor(pixel);
  // A skybox has the depth of an empty sample, but nonzero alpha.
  if (depth >= 1.0 && background < 0.5 && color.a <= 0.0)
  {
    discard;
  }
  float occlusion = 0.0;
  if (depth < 1.0)
  {
    vec3 surface = surfacePosition(pixel, depth);
    occlusion = surface.z < 0.5 * farAway ? texture(occlusions, surface.xy).r : 0.0;
  }
  gl_FragData[0] = vec4(applyOcclusion(color.rgb, occlusion), color.a);
  gl_FragDepth = depth < 1.0 ? toTargetDepth.x * depth + toTargetDepth.y : 1.0;
}
