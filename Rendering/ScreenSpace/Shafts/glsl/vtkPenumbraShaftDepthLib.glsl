// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lit fraction of a view ray, from the depth buffer. The path from the point at depth s of the view
// ray to the light projects to the screen positions plane + q (light.xy - plane light.z), for every
// s. Its depth at q is s / (1 - q light.z). One march over q therefore finds all shadowed depths s:
// those behind the visible surface by at most its thickness. The CDF of in-scattering along the ray
// is divided into 64 bins; a bit of two words marks a shadowed bin. For a positional light at M,
// 1/d becomes 1/d - q.
uniform float thickness; // of visible surfaces, along the view axis
uniform int steps;       // depth fetches per ray
uniform float range;     // upper bound of the distance of every surface from the eye

const float bias = 0.002;    // relative depth offset against self-shadowing
const float unreached = 1e30;

// The lowest `count` bits.
uint lowBits(float count)
{
  return count >= 32.0 ? 0xffffffffu : (1u << uint(max(count, 0.0))) - 1u;
}

// Bins whose reference point, the fraction `point` of a bin, lies between two values of the CDF.
uvec2 bitsBetween(float low, float high, float point)
{
  float first = ceil(low * 64.0 - point);
  float last = ceil(high * 64.0 - point);
  return uvec2(lowBits(last) & ~lowBits(first), lowBits(last - 32.0) & ~lowBits(first - 32.0));
}

// First and last depth of the view ray that a surface at `depth` shadows at q.
vec2 shadowedDepths(float depth, float q)
{
  vec2 span = vec2(depth, depth + thickness);
  if (perspective < 0.5)
  {
    return (span - q * light.z) / max(1.0 - q * light.w, 1e-6);
  }
  vec2 inverse = 1.0 / span - q * light.w;
  float remaining = max(1.0 - q * light.z, 0.0);
  return vec2(inverse.x > 0.0 ? remaining / inverse.x : unreached,
    inverse.y > 0.0 ? remaining / inverse.y : unreached);
}

// The q at which the path reaches the light or leaves the image.
float lastStep(vec2 pixel, vec2 pixelsPerQ)
{
  vec2 room = mix(pixel, 1.0 / pixelSize - pixel, step(0.0, pixelsPerQ));
  vec2 edge = room / max(abs(pixelsPerQ), 1e-9);
  float end = perspective > 0.5 ? 1.0 / max(light.z, 1e-9)
                                : (light.w > 0.5 ? 1.0 : range / max(abs(light.z), 1e-9));
  return min(min(edge.x, edge.y), end);
}

// A pixel is interpolated from four texels. Their marches start a quarter of a step apart and test
// different quarters of each bin, which hides the spacing of steps and bins.
float startOf(vec2 odd)
{
  return 0.125 + 0.5 * odd.x + 0.25 * abs(odd.x - odd.y);
}

float binPointOf(vec2 odd)
{
  return 0.125 + 0.5 * abs(odd.x - odd.y) + 0.25 * odd.y;
}

float estimateLitFraction(ViewRay ray, vec2 pixel, float eyeDepth)
{
  float planeFactor = perspective > 0.5 ? light.z : light.w;
  vec2 pixelsPerQ = pixelOffsetOnPlane(light.xy - ray.plane * planeFactor);
  float stride = lastStep(pixel, pixelsPerQ) / float(steps);
  uvec2 shadowed = uvec2(0u);
  float square = max(dot(pixelsPerQ, pixelsPerQ), 1e-12);
  vec2 odd = mod(floor(pixel), 2.0);
  float start = startOf(odd);
  float point = binPointOf(odd);
  float previousDepth = eyeDepth;
  vec2 previousSpan = vec2(eyeDepth, eyeDepth + thickness);
  int i = 0;
  do
  {
    // A depth is valid at the center of its texel.
    vec2 texel = floor(pixel + stride * (float(i) + start) * pixelsPerQ) + 0.5;
    float q = max(dot(texel - pixel, pixelsPerQ) / square, 0.0);
    float depth = texture(eyeDepths, texel * pixelSize).r * (1.0 + bias);
    // Consecutive steps on the same surface are connected. On a new surface, a step covers half a
    // step before and half a step after it.
    vec2 span = shadowedDepths(depth, q);
    bool sameSurface = abs(depth - previousDepth) < thickness;
    vec2 before = previousSpan;
    vec2 after = span;
    if (!sameSurface)
    {
      before = shadowedDepths(depth, max(q - 0.5 * stride, 0.0));
      after = shadowedDepths(depth, min(q + 0.5 * stride, stride * float(steps)));
    }
    float low = min(min(before.x, after.x), span.x);
    float high = max(max(before.y, after.y), span.y);
    if (depth < 0.5 * farAway && low < eyeDepth)
    {
      shadowed |= bitsBetween(cdfOfLength(ray, max(low, 0.0) * ray.lengthPerDepth),
        cdfOfLength(ray, max(min(high, eyeDepth), 0.0) * ray.lengthPerDepth), point);
    }
    previousDepth = depth;
    previousSpan = span;
    ++i;
  } while (i < steps);
  return litFractionOf(ray, shadowed);
}
