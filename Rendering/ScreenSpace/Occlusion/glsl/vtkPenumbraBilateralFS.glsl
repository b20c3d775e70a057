//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// One direction of the separable 5 x 5 cross-bilateral filter [TSSAO eq. 10-11]. The weight of a
// neighbor depends on its distance in space, its distance from the tangent plane, and its number of
// samples. Converged pixels are not filtered.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::SurfaceLib
//VTK::Penumbra::BilateralLib
uniform sampler2D values;       // r: sum, g: number of samples
uniform float mean;             // 1: write the mean; 0: sum and number, for the second direction
uniform vec2 direction;               // (1, 0) or (0, 1)
uniform float convergedWeight;  // pixels with at least this many samples are not filtered

// Returns the sum and number of samples of a neighbor, multiplied by its weight.
vec2 weightedSample(vec2 tap, vec3 delta, vec3 inPlane, float samples, float pixelWidth)
{
  return neighborWeight(delta, inPlane, samples, pixelWidth) * texture(values, tap * pixelSize).rg;
}

void main()
{
  vec2 pixel = gl_FragCoord.xy;
  float depth = texture(eyeDepths, pixel * pixelSize).r;
  vec3 position = eyePosition(pixel, depth);
  vec2 center = texture(values, pixel * pixelSize).rg;
  float filterStrength = clamp(1.0 - center.g / convergedWeight, 0.0, 1.0);
  float pixelWidth = pixelToEye.x * mix(1.0, depth, perspective);
  vec2 sum = center;
  if (filterStrength > 0.0)
  {
    vec3 ahead = eyePositionAt(pixel + direction) - position;
    vec3 behind = eyePositionAt(pixel - direction) - position;
    vec3 along = minDiff(ahead, -behind, position, pixel + direction);
    vec2 neighbors = weightedSample(pixel + direction, ahead, along, center.g, pixelWidth) +
      weightedSample(pixel - direction, behind, -along, center.g, pixelWidth);
    vec2 tap = pixel + 2.0 * direction;
    neighbors +=
      weightedSample(tap, eyePositionAt(tap) - position, 2.0 * along, center.g, pixelWidth);
    tap = pixel - 2.0 * direction;
    neighbors +=
      weightedSample(tap, eyePositionAt(tap) - position, -2.0 * along, center.g, pixelWidth);
    sum += filterStrength * neighbors;
  }
  float value = sum.x / max(sum.y, 1e-6);
  gl_FragData[0] = vec4(mean > 0.5 ? min(value, 1.0) : center.g * value, center.g, 0.0, 1.0);
}
