//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Brightness, a colour's largest component, over cells of 16 x 16 pixels: r the sum of what is left of
// the picture, g and b the least and largest scattered light, a the number of pixels.
uniform sampler2D shafts;    // rgb: scattered light, a: transmittance
uniform sampler2D depthBuffer;
uniform vec2 pixelSize;
uniform float background;    // 1: the delegate draws it
uniform vec3 behind;         // else its colour
//VTK::Penumbra::Picture

const int cell = 16;

float brightest(vec3 color)
{
  return max(max(color.r, color.g), color.b);
}

void main()
{
  vec2 corner = float(cell) * floor(gl_FragCoord.xy);
  vec4 found = vec4(0.0, 1e30, 0.0, 0.0);
  for (int i = 0; i < cell * cell; ++i)
  {
    vec2 pixel = corner + vec2(float(i % cell), float(i / cell)) + 0.5;
    bool inside = all(lessThan(pixel * pixelSize, vec2(1.0)));
    vec4 seen = pictureAt(pixel);
    vec4 fog = texture(shafts, pixel * pixelSize);
    float scattered = brightest(fog.rgb);
    float left = fog.a * brightest(seen.rgb + (1.0 - seen.a) * behind);
    vec4 here = vec4(found.r + left, min(found.g, scattered), max(found.b, scattered), found.a + 1.0);
    found = inside ? here : found;
  }
  gl_FragData[0] = found;
}
