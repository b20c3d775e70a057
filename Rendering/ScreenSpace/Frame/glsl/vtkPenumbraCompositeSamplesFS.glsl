//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Draws a scene image with several samples per pixel. Each sample is darkened by the occlusion of
// its surface, which at an edge is that of a neighboring pixel. Antialiased edges therefore get no
// halos.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::SampleSurfaceLib
//VTK::Penumbra::ApplyOcclusionLib
uniform sampler2DMS colors;
uniform sampler2DMS depthSamples;
uniform sampler2D occlusions;
uniform int sampleCount;
uniform vec2 offset;      // from pixels of the target to those of the scene image
uniform vec2 toTargetDepth; // x * depth + y: from depths of the image to those of the target
uniform float background; // 1: empty samples are drawn, too; 0: the target keeps them

// Occlusion of the surface of a sample.
float sampleOcclusion(float sampleDepth, vec2 pixel, float slope)
{
  vec3 surface = positionOfSurface(sampleDepth, pixel, slope);
  return surface.z < 0.5 * farAway ? texture(occlusions, surface.xy).r : 0.0;
}

void main()
{
  vec2 pixel = gl_FragCoord.xy + offset;
  vec4 sum = vec4(0.0);
  float covered = 0.0;
  float frontmost = 1.0;
  float slope = depthSlope(pixel);
  for (int i = 0; i < sampleCount; ++i)
  {
    float depth = texelFetch(depthSamples, ivec2(pixel), i).r;
    vec4 color = texelFetch(colors, ivec2(pixel), i);
    // A skybox has the depth of an empty sample, but nonzero alpha.
    float coverage = depth < 1.0 || background > 0.5 || color.a > 0.0 ? 1.0 : 0.0;
    float occlusion = depth < 1.0 ? sampleOcclusion(eyeDepthOfBuffer(depth), pixel, slope) : 0.0;
    sum += coverage * vec4(applyOcclusion(color.rgb, occlusion), color.a);
    covered += coverage;
    frontmost = min(frontmost, depth);
  }
  if (covered == 0.0)
  {
    discard;
  }
  // Blended over the target with premultiplied alpha, the fraction of covered samples.
  gl_FragData[0] = sum / float(sampleCount);
  bool solid = 2.0 * covered >= float(sampleCount) && frontmost < 1.0;
  gl_FragDepth = solid ? toTargetDepth.x * frontmost + toTargetDepth.y : 1.0;
}
