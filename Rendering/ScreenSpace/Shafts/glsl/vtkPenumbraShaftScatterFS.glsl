//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// In-scattered light of a group of lights: the closed form of a lit ray times the lit fraction,
// which is interpolated from texels of similar depth. Alpha is computed from the transmittance of
// the medium.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::ShaftLib
uniform sampler2D eyeDepths;
uniform sampler2D litFractions;
uniform vec2 texelSize;       // 1 / size of litFractions
uniform float blockSize;      // pixels per side of a texel
uniform float interleaved;    // 1: interpolate four texels per pixel
uniform vec3 colors[3];       // of the lights, exposure included
uniform int referenceChannel; // the most transparent one: alpha is its transmittance
uniform vec2 alpha;           // the output's alpha is x + y * transmittance
uniform vec2 offset;          // from pixels of the target to those of the scene image

// Relative depth difference at which the weight of a texel falls to 1/2.
const float depthTolerance = 0.02;

//VTK::Penumbra::LitFraction

// COLORED is defined if each channel has its own coefficients.
//VTK::Penumbra::Channels

// Mean over 2 x 2 texels, weighted by similarity of depth. The weights of even and odd texels are
// equal at every pixel, so that their interleaved starts cancel out.
vec3 litFractionsAt(vec2 pixel, float eyeDepth)
{
  vec2 position = (pixel - floor(0.5 * blockSize) - 0.5) / blockSize;
  vec2 center = floor(position + 0.5);
  vec2 delta = position - center;
  vec4 sums = vec4(0.0);
  for (int i = 0; i < 9; ++i)
  {
    vec2 neighbor = vec2(float(i % 3 - 1), float(i / 3 - 1));
    vec2 spatial = mix(vec2(1.0), 0.5 + neighbor * delta, abs(neighbor));
    vec4 texel = texture(litFractions, (center + neighbor + 0.5) * texelSize);
    float difference = (texel.a - eyeDepth) / (depthTolerance * min(texel.a, eyeDepth));
    float similarity = max(1.0 / (1.0 + difference * difference), 1e-6);
    sums += spatial.x * spatial.y * similarity * vec4(texel.rgb, 1.0);
  }
  return sums.rgb / sums.a;
}

void main()
{
  vec2 pixel = gl_FragCoord.xy + offset;
  float eyeDepth = texture(eyeDepths, pixel * pixelSize).r;
  vec3 lit =
    interleaved > 0.5 ? litFractionsAt(pixel, eyeDepth) : texture(litFractions, pixel * texelSize).rgb;
  vec3 sum = vec3(0.0);
  float transmittance = 1.0;
  int i = 0;
  do
  {
    light = lights[i];
    selectChannel(referenceChannel);
    ViewRay ray = makeViewRay(pixel, eyeDepth);
    transmittance = exp(-min(extinction * ray.column, 80.0));
    vec3 scattered = vec3(inScattering(ray));
#ifdef COLORED
    for (int channel = 0; channel < 3; ++channel)
    {
      selectChannel(channel);
      vec3 component = vec3(equal(ivec3(0, 1, 2), ivec3(channel)));
      scattered = mix(scattered, vec3(inScattering(makeViewRay(pixel, eyeDepth))), component);
    }
#endif
    sum += colors[i] * litFraction(i, lit) * scattered;
    ++i;
  } while (i < lightCount);
  gl_FragData[0] = vec4(sum, alpha.x + alpha.y * transmittance);
}
