//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Reduces brightness, the largest component of a color, over cells of 16 x 16 pixels. r: sum of the
// attenuated scene, g and b: minimum and maximum of the in-scattered light, a: number of pixels.
uniform sampler2D shafts;      // rgb: in-scattered light, a: transmittance
uniform sampler2D depthBuffer;
uniform vec2 pixelSize;        // 1 / size of the image
uniform float background;      // 1: the delegate draws the background
uniform vec3 backgroundColor;  // used if the delegate does not draw the background
//VTK::Penumbra::SceneColor

const int cellSize = 16; // as CellSize in ShaftAutoExposure.cxx

float brightnessOf(vec3 color)
{
  return max(max(color.r, color.g), color.b);
}

void main()
{
  vec2 corner = float(cellSize) * floor(gl_FragCoord.xy);
  vec4 result = vec4(0.0, 1e30, 0.0, 0.0);
  for (int i = 0; i < cellSize * cellSize; ++i)
  {
    vec2 pixel = corner + vec2(float(i % cellSize), float(i / cellSize)) + 0.5;
    bool inside = all(lessThan(pixel * pixelSize, vec2(1.0)));
    vec4 scene = sceneColorAt(pixel);
    vec4 medium = texture(shafts, pixel * pixelSize);
    float scattered = brightnessOf(medium.rgb);
    float attenuated = medium.a * brightnessOf(scene.rgb + (1.0 - scene.a) * backgroundColor);
    vec4 updated =
      vec4(result.r + attenuated, min(result.g, scattered), max(result.b, scattered), result.a + 1.0);
    result = inside ? updated : result;
  }
  gl_FragData[0] = result;
}
