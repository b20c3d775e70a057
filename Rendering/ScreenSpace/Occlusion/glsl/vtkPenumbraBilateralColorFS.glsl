//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// One direction of a separable cross-bilateral filter of colors [TSSAO eq. 10]. The weight of a
// neighbor is a Gaussian of its distance in depth or in space, multiplied by the weight of that
// pixel.
//VTK::Penumbra::ViewLib
uniform sampler2D colors;
uniform sampler2D eyeDepths;
uniform sampler2D weights;
uniform vec2 direction;  // (1, 0) or (0, 1)
uniform int reach;       // radius of the filter, in pixels
uniform float distance;  // distance at which the weight of a neighbor falls to 1/e
uniform float byDepth;   // 1: distance along the view axis; 0: distance in space

void main()
{
  vec2 pixel = gl_FragCoord.xy;
  vec3 position = eyePosition(pixel, texture(eyeDepths, pixel * pixelSize).r);
  vec4 sum = vec4(0.0);
  float total = 0.0;
  for (int i = -reach; i <= reach; ++i)
  {
    vec2 tap = pixel + float(i) * direction;
    vec2 at = tap * pixelSize;
    vec3 delta = (eyePosition(tap, texture(eyeDepths, at).r) - position) / distance;
    delta.xy *= 1.0 - byDepth;
    bool isInside = all(greaterThan(at, vec2(0.0))) && all(lessThan(at, vec2(1.0)));
    float weight = isInside ? texture(weights, at).r * exp(-dot(delta, delta)) : 0.0;
    sum += weight * texture(colors, at);
    total += weight;
  }
  gl_FragData[0] = total > 0.0 ? sum / total : texture(colors, pixel * pixelSize);
}
