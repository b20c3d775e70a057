//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What some lights add to every pixel, in closed form times the lit shares, which are taken from the
// texels around that see as far; and what the medium leaves of the picture.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::ShaftLib
uniform sampler2D eyeDepths;
uniform sampler2D litShares;
uniform vec2 texelSize;       // of litShares
uniform float block;          // pixels a side of a texel
uniform float interleaved;    // 1: four texels make a pixel
uniform vec3 colors[3];       // the lights', exposure included
uniform vec2 alpha;           // x + y * what is left of the picture
uniform vec2 offset;          // from pixels of the target to those of the scene's picture

// Depths this much apart, relatively, are other surfaces.
const float apart = 0.02;

//VTK::Penumbra::Share

// The mean over two texels by two, those that see elsewhere left out: texels with an even number count
// as much as those with an odd one, wherever the pixel lies, so that interleaved starts cancel out.
vec3 litSharesAt(vec2 pixel, float eyeDepth)
{
  vec2 at = (pixel - floor(0.5 * block) - 0.5) / block;
  vec2 middle = floor(at + 0.5);
  vec2 aside = at - middle;
  vec4 sums = vec4(0.0);
  for (int i = 0; i < 9; ++i)
  {
    vec2 step = vec2(float(i % 3 - 1), float(i / 3 - 1));
    vec2 share = mix(vec2(1.0), 0.5 + step * aside, abs(step));
    vec4 found = texture(litShares, (middle + step + 0.5) * texelSize);
    float other = (found.a - eyeDepth) / (apart * min(found.a, eyeDepth));
    float alike = max(1.0 / (1.0 + other * other), 1e-6);
    sums += share.x * share.y * alike * vec4(found.rgb, 1.0);
  }
  return sums.rgb / sums.a;
}

void main()
{
  vec2 pixel = gl_FragCoord.xy + offset;
  float eyeDepth = texture(eyeDepths, pixel * pixelSize).r;
  vec3 lit = interleaved > 0.5 ? litSharesAt(pixel, eyeDepth) : texture(litShares, pixel * texelSize).rgb;
  vec3 sum = vec3(0.0);
  float left = 1.0;
  for (int i = 0; i < lightCount; ++i)
  {
    light = lights[i];
    Sight sight = sightThrough(pixel, eyeDepth);
    sum += colors[i] * litBy(i, lit) * scatteredIn(sight);
    left = exp(-min(extinction * sight.through, 80.0));
  }
  gl_FragData[0] = vec4(sum, alpha.x + alpha.y * left);
}
