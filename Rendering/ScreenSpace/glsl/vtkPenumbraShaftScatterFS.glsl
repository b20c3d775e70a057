//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What one light adds to every pixel, in closed form times the lit share, which is taken from the
// texels around that see as far; and what the medium leaves of the picture.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::ShaftLib
uniform sampler2D eyeDepths;
uniform sampler2D litShares;
uniform vec2 texelSize;       // of litShares
uniform float block;          // pixels a side of a texel
uniform vec3 color;           // the light's, exposure included
uniform float transmittance;  // 1: alpha is what is left of the picture; 0: alpha is 0

// Depths this much apart, relatively, are other surfaces.
const float apart = 0.02;

// Texels count by their distance, and this much besides: less noise, and less change from frame to
// frame. Measured: ./penumbra benchmark light-shafts.
const float evenly = 0.25;

//VTK::Penumbra::Share

vec3 litShareAt(vec2 pixel, float eyeDepth)
{
  vec2 at = (pixel - floor(0.5 * block) - 0.5) / block;
  vec2 corner = floor(at);
  vec2 share = at - corner;
  vec4 sums = vec4(0.0);
  for (int i = 0; i < 4; ++i)
  {
    vec2 offset = vec2(float(i % 2), float(i / 2));
    vec2 near = mix(1.0 - share, share, offset);
    vec4 found = foundShare((corner + offset + 0.5) * texelSize);
    float other = (found.a - eyeDepth) / (apart * min(found.a, eyeDepth));
    float alike = max(1.0 / (1.0 + other * other), 1e-6);
    sums += (near.x * near.y + evenly) * alike * vec4(found.rgb, 1.0);
  }
  return sums.rgb / sums.a;
}

void main()
{
  vec2 pixel = gl_FragCoord.xy;
  float eyeDepth = texture(eyeDepths, pixel * pixelSize).r;
  Sight sight = sightThrough(pixel, eyeDepth);
  vec3 lit = block > 1.5 ? litShareAt(pixel, eyeDepth) : foundShare(pixel * texelSize).rgb;
  float left = exp(-min(extinction * sight.through, 80.0));
  gl_FragData[0] = vec4(color * (lit * scatteredIn(sight)), transmittance * left);
}
