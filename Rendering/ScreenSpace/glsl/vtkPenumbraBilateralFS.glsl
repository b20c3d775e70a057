//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// One direction of the separable 5 x 5 cross-bilateral filter [TSSAO eq. 10-11]: neighbours count by
// their distance in space, by that from the plane and by their own convergence. Where a pixel has
// converged its neighbours no longer count.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::SurfaceLib
//VTK::Penumbra::BilateralLib
uniform sampler2D values;       // r: sum, g: number of samples
uniform float mean;             // 1: write the mean; 0: sum and number, for the other direction
uniform vec2 way;               // (1, 0) or (0, 1)
uniform float convergedWeight;  // from this weight on a pixel is left alone

void main()
{
  vec2 pixel = gl_FragCoord.xy;
  float depth = texture(eyeDepths, pixel * pixelSize).r;
  vec3 position = eyePosition(pixel, depth);
  vec2 own = texture(values, pixel * pixelSize).rg;
  float shrink = clamp(1.0 - own.g / convergedWeight, 0.0, 1.0);
  float pixelWidth = pixelToEye.x * mix(1.0, depth, perspective);
  vec2 sum = own;
  // All taps or none: a block of pixels that has converged leaves the loops at once.
  int last = shrink > 0.0 ? 2 : -3;
  vec3 along = vec3(0.0);
  for (int i = 0; i <= min(last, 0); ++i)
  {
    along = nearerNeighbour(position, pixel, way);
  }
  for (int i = -2; i <= last; ++i)
  {
    vec2 tap = pixel + float(i) * way;
    vec2 other = texture(values, tap * pixelSize).rg;
    vec3 apart = eyePositionAt(tap) - position;
    float weight = shrink * neighbourWeight(apart, float(i) * along, own.g, pixelWidth);
    sum += i == 0 ? vec2(0.0) : weight * other;
  }
  float value = sum.x / max(sum.y, 1e-6);
  gl_FragData[0] = vec4(mean > 0.5 ? min(value, 1.0) : own.g * value, own.g, 0.0, 1.0);
}
