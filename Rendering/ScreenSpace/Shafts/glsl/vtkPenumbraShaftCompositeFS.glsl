//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The scene seen through the medium, each sample through that in front of its surface: color *
// transmittance + in-scattered light, to be blended over the target. Alpha is the opacity of
// surfaces and medium together.
//VTK::Penumbra::ViewLib
uniform sampler2D shafts;  // rgb: in-scattered light, a: transmittance
uniform sampler2D depthBuffer;
uniform float gain;        // factor on the in-scattered light
uniform vec2 offset;       // from pixels of the target to those of the scene image
uniform float background;  // 1: empty pixels belong to the scene image; 0: the target shows through
uniform vec3 extinctionRatios; // of the channels to the one whose transmittance is stored
uniform int part;              // 0: gray; colored: 1: factor on the target, 2: what is added to it
//VTK::Penumbra::SampleSurfaceLib
//VTK::Penumbra::SceneColor

void main()
{
  vec2 pixel = gl_FragCoord.xy + offset;
  float slope = sampleCount > 1 ? depthSlope(pixel) : 0.0;
  vec3 color = vec3(0.0);
  vec4 behind = vec4(0.0); // factor on what is behind the scene image
  for (int i = 0; i < sampleCount; ++i)
  {
    // At an edge, the surface of a sample is that of a neighboring pixel.
    vec2 surface = sampleCount > 1
      ? positionOfSurface(eyeDepthOfBuffer(sampleDepth(pixel, i)), pixel, slope).xy
      : pixel * pixelSize;
    vec4 scene = sampleColor(pixel, i);
    vec4 medium = texture(shafts, surface);
    vec3 transmittance = part > 0 ? pow(vec3(medium.a), extinctionRatios) : vec3(medium.a);
    color += scene.rgb * transmittance + gain * medium.rgb;
    behind += (1.0 - scene.a) * vec4(transmittance, medium.a);
  }
  float count = float(sampleCount);
  gl_FragData[0] = (part == 1 ? behind : vec4(color, count - behind.a)) / count;
  gl_FragDepth = texture(depthBuffer, pixel * pixelSize).r;
}
