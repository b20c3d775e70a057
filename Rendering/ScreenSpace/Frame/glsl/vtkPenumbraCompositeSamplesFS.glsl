//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The scene with several samples a pixel, darkened: each sample by the occlusion of the surface that
// it shows, which at an edge is that of a neighbouring pixel. So edges stay smooth and get no halos.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::ApplyOcclusionLib
uniform sampler2DMS colors;
uniform sampler2DMS depthSamples;
uniform sampler2D eyeDepths;
uniform sampler2D occlusions;
uniform int sampleCount;
uniform vec2 offset;      // from pixels of the target to those of the scene's picture
uniform vec2 toTargetDepth; // a depth of the picture times x plus y is the target's
uniform float background; // 1: samples without a surface are the scene's, too; 0: they stay

// Relative depth within which a sample shows the same surface as its pixel.
const float sameSurface = 0.02;

// Of the pixel and, if it does not show the sample's surface, its neighbours: the nearest in depth.
float occlusionOf(float sampleDepth, vec2 pixel)
{
  float nearest = abs(texture(eyeDepths, pixel * pixelSize).r - sampleDepth);
  float occlusion = texture(occlusions, pixel * pixelSize).r;
  int count = nearest > sameSurface * sampleDepth ? 9 : 0;
  for (int i = 0; i < count; ++i)
  {
    vec2 at = (pixel + vec2(float(i % 3 - 1), float(i / 3 - 1))) * pixelSize;
    float apart = abs(texture(eyeDepths, at).r - sampleDepth);
    occlusion = apart < nearest ? texture(occlusions, at).r : occlusion;
    nearest = min(apart, nearest);
  }
  return nearest < 0.5 * farAway ? occlusion : 0.0;
}

void main()
{
  vec2 pixel = gl_FragCoord.xy + offset;
  vec4 sum = vec4(0.0);
  float covered = 0.0;
  float frontmost = 1.0;
  for (int i = 0; i < sampleCount; ++i)
  {
    float depth = texelFetch(depthSamples, ivec2(pixel), i).r;
    vec4 color = texelFetch(colors, ivec2(pixel), i);
    // A skybox has the depth of an empty sample, but a color.
    float counts = depth < 1.0 || background > 0.5 || color.a > 0.0 ? 1.0 : 0.0;
    float occlusion = depth < 1.0 ? occlusionOf(eyeDepthOfBuffer(depth), pixel) : 0.0;
    sum += counts * vec4(applyOcclusion(color.rgb, occlusion), color.a);
    covered += counts;
    frontmost = min(frontmost, depth);
  }
  if (covered == 0.0)
  {
    discard;
  }
  // To be blended over what is there: alpha is the share of the samples.
  gl_FragData[0] = sum / float(sampleCount);
  bool solid = 2.0 * covered >= float(sampleCount) && frontmost < 1.0;
  gl_FragDepth = solid ? toTargetDepth.x * frontmost + toTargetDepth.y : 1.0;
}
