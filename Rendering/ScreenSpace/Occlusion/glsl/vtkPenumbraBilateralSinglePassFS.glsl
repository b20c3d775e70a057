//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The 5 x 5 cross-bilateral filter [TSSAO eq. 10-11] in one step, for pictures of which only spots
// have not converged: everything that the others do not need stands in the loop, which they leave.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::SurfaceLib
//VTK::Penumbra::BilateralLib
uniform sampler2D values;       // r: sum, g: number of samples
uniform float convergedWeight;  // from this weight on a pixel is left alone

void main()
{
  vec2 pixel = gl_FragCoord.xy;
  vec2 own = texture(values, pixel * pixelSize).rg;
  float shrink = clamp(1.0 - own.g / convergedWeight, 0.0, 1.0);
  vec2 sum = own;
  int last = shrink > 0.0 ? 24 : -1;
  vec3 position = vec3(0.0);
  vec3 right = vec3(0.0);
  vec3 up = vec3(0.0);
  for (int i = 0; i <= min(last, 0); ++i)
  {
    position = eyePositionAt(pixel);
    right = nearerNeighbour(position, pixel, vec2(1.0, 0.0));
    up = nearerNeighbour(position, pixel, vec2(0.0, 1.0));
  }
  float pixelWidth = pixelToEye.x * mix(1.0, -position.z, perspective);
  for (int i = 0; i <= last; ++i)
  {
    float row = floor((float(i) + 0.5) / 5.0);
    vec2 step = vec2(float(i) - 5.0 * row, row) - 2.0;
    vec2 tap = pixel + step;
    vec2 other = texture(values, tap * pixelSize).rg;
    vec3 apart = eyePositionAt(tap) - position;
    float weight = shrink * neighbourWeight(apart, step.x * right + step.y * up, own.g, pixelWidth);
    sum += i == 12 ? vec2(0.0) : weight * other;
  }
  gl_FragData[0] = vec4(min(sum.x / max(sum.y, 1e-6), 1.0));
}
