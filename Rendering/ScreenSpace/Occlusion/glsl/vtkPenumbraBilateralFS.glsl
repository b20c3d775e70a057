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

// A neighbour's sum and number, weighed.
vec2 from(vec2 tap, vec3 apart, vec3 inPlane, float samples, float pixelWidth)
{
  return neighbourWeight(apart, inPlane, samples, pixelWidth) * texture(values, tap * pixelSize).rg;
}

void main()
{
  vec2 pixel = gl_FragCoord.xy;
  float depth = texture(eyeDepths, pixel * pixelSize).r;
  vec3 position = eyePosition(pixel, depth);
  vec2 own = texture(values, pixel * pixelSize).rg;
  float shrink = clamp(1.0 - own.g / convergedWeight, 0.0, 1.0);
  float pixelWidth = pixelToEye.x * mix(1.0, depth, perspective);
  vec2 sum = own;
  // Once or never: a block of pixels that has converged leaves the loop at once.
  int times = shrink > 0.0 ? 1 : 0;
  for (int i = 0; i < times; ++i)
  {
    vec3 ahead = eyePositionAt(pixel + way) - position;
    vec3 behind = eyePositionAt(pixel - way) - position;
    vec3 along = nearerOf(ahead, -behind, position, pixel + way);
    vec2 near = from(pixel + way, ahead, along, own.g, pixelWidth) +
      from(pixel - way, behind, -along, own.g, pixelWidth);
    vec2 far = pixel + 2.0 * way;
    near += from(far, eyePositionAt(far) - position, 2.0 * along, own.g, pixelWidth);
    far = pixel - 2.0 * way;
    near += from(far, eyePositionAt(far) - position, -2.0 * along, own.g, pixelWidth);
    sum += shrink * near;
  }
  float value = sum.x / max(sum.y, 1e-6);
  gl_FragData[0] = vec4(mean > 0.5 ? min(value, 1.0) : own.g * value, own.g, 0.0, 1.0);
}
