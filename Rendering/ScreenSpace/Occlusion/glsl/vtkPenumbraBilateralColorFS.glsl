//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// One direction of a separable cross-bilateral filter of colours [TSSAO eq. 10]: neighbours count by
// how far they are in depth or in space, and by a weight of their own.
//VTK::Penumbra::ViewLib
uniform sampler2D colors;
uniform sampler2D eyeDepths;
uniform sampler2D weights;
uniform vec2 way;        // (1, 0) or (0, 1)
uniform int reach;       // pixels on each side
uniform float distance;  // at which a neighbour counts 1/e
uniform float byDepth;   // 1: distance along the view axis, 0: in space

void main()
{
  vec2 pixel = gl_FragCoord.xy;
  vec3 position = eyePosition(pixel, texture(eyeDepths, pixel * pixelSize).r);
  vec4 sum = vec4(0.0);
  float total = 0.0;
  for (int i = -reach; i <= reach; ++i)
  {
    vec2 tap = pixel + float(i) * way;
    vec2 at = tap * pixelSize;
    vec3 apart = (eyePosition(tap, texture(eyeDepths, at).r) - position) / distance;
    apart.xy *= 1.0 - byDepth;
    bool inside = all(greaterThan(at, vec2(0.0))) && all(lessThan(at, vec2(1.0)));
    float weight = inside ? texture(weights, at).r * exp(-dot(apart, apart)) : 0.0;
    sum += weight * texture(colors, at);
    total += weight;
  }
  gl_FragData[0] = total > 0.0 ? sum / total : texture(colors, pixel * pixelSize);
}
