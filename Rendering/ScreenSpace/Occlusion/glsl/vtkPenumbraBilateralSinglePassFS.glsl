//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The 5 x 5 cross-bilateral filter [TSSAO eq. 10-11] in a single pass, for images in which few
// pixels have not converged. Converged pixels skip the loops, which contain all the work of the
// filter.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::SurfaceLib
//VTK::Penumbra::BilateralLib
uniform sampler2D values;       // r: sum, g: number of samples
uniform float convergedWeight;  // pixels with at least this many samples are not filtered

void main()
{
  vec2 pixel = gl_FragCoord.xy;
  vec2 center = texture(values, pixel * pixelSize).rg;
  float filterStrength = clamp(1.0 - center.g / convergedWeight, 0.0, 1.0);
  vec2 sum = center;
  int last = filterStrength > 0.0 ? 24 : -1;
  vec3 position = vec3(0.0);
  vec3 right = vec3(0.0);
  vec3 up = vec3(0.0);
  if (filterStrength > 0.0)
  {
    position = eyePositionAt(pixel);
    right = minDiffNeighbor(position, pixel, vec2(1.0, 0.0));
    up = minDiffNeighbor(position, pixel, vec2(0.0, 1.0));
  }
  float pixelWidth = pixelToEye.x * mix(1.0, -position.z, perspective);
  for (int i = 0; i <= last; ++i)
  {
    float row = floor((float(i) + 0.5) / 5.0);
    vec2 offset = vec2(float(i) - 5.0 * row, row) - 2.0;
    vec2 tap = pixel + offset;
    vec2 value = texture(values, tap * pixelSize).rg;
    vec3 delta = eyePositionAt(tap) - position;
    vec3 inPlane = offset.x * right + offset.y * up;
    float weight = filterStrength * neighborWeight(delta, inPlane, center.g, pixelWidth);
    sum += i == 12 ? vec2(0.0) : weight * value;
  }
  gl_FragData[0] = vec4(min(sum.x / max(sum.y, 1e-6), 1.0));
}
