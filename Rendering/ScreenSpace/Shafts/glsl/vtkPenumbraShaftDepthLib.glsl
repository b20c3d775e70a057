// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Which part of a view ray is lit, from depth alone. The way from the point at depth s of the view
// ray to the light crosses the screen at plane + q (light.xy - plane light.z), whatever s, and there
// s (1 - q light.z)^-1 is its depth: one march over q tells which s are shadowed, those that lie
// behind what is seen there, by no more than its thickness. Shadowed bins of shares are kept as bits.
// A lamp at M: 1/d becomes 1/d - q.
uniform float thickness; // of what is seen, along the view axis
uniform int steps;
uniform float range;     // no surface is farther than this

const float bias = 0.002;    // relative, against surfaces that shadow themselves
const float unreached = 1e30;

// The lowest `count` bits.
uint lowBits(float count)
{
  return count >= 32.0 ? 0xffffffffu : (1u << uint(max(count, 0.0))) - 1u;
}

// Bins of which the part `point` lies between.
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
  float left = max(1.0 - q * light.z, 0.0);
  return vec2(inverse.x > 0.0 ? left / inverse.x : unreached,
    inverse.y > 0.0 ? left / inverse.y : unreached);
}

// The q at which the way to the light ends, or leaves the picture.
float lastStep(vec2 pixel, vec2 way)
{
  vec2 room = mix(pixel, 1.0 / pixelSize - pixel, step(0.0, way));
  vec2 border = room / max(abs(way), 1e-9);
  float ends = perspective > 0.5 ? 1.0 / max(light.z, 1e-9)
                                 : (light.w > 0.5 ? 1.0 : range / max(abs(light.z), 1e-9));
  return min(min(border.x, border.y), ends);
}

// A pixel is mixed from four texels: each starts a quarter of a step later, and looks at another quarter
// of each bin, so that neither steps nor bins are seen.
float startOf(vec2 odd)
{
  return 0.125 + 0.5 * odd.x + 0.25 * abs(odd.x - odd.y);
}

float quarterOf(vec2 odd)
{
  return 0.125 + 0.5 * abs(odd.x - odd.y) + 0.25 * odd.y;
}

float litShareOf(Sight sight, vec2 pixel, float eyeDepth)
{
  float turn = perspective > 0.5 ? light.z : light.w;
  vec2 way = (light.xy - sight.plane * turn) / pixelToEye.xy;
  float stride = lastStep(pixel, way) / float(steps);
  uvec2 shadowed = uvec2(0u);
  float square = max(dot(way, way), 1e-12);
  vec2 odd = mod(floor(pixel), 2.0);
  float start = startOf(odd);
  float point = quarterOf(odd);
  float before = eyeDepth;
  vec2 last = vec2(eyeDepth, eyeDepth + thickness);
  for (int i = 0; i < steps; ++i)
  {
    // A depth is that of its texel's middle.
    vec2 at = floor(pixel + stride * (float(i) + start) * way) + 0.5;
    float q = max(dot(at - pixel, way) / square, 0.0);
    float depth = texture(eyeDepths, at * pixelSize).r * (1.0 + bias);
    // A surface goes on between two steps that both show it; where another one comes into sight, a step
    // stands for what lies half a step before and after it.
    vec2 depths = shadowedDepths(depth, q);
    bool same = abs(depth - before) < thickness;
    vec2 sooner = last;
    vec2 later = depths;
    if (!same)
    {
      sooner = shadowedDepths(depth, max(q - 0.5 * stride, 0.0));
      later = shadowedDepths(depth, min(q + 0.5 * stride, stride * float(steps)));
    }
    float low = min(min(sooner.x, later.x), depths.x);
    float high = max(max(sooner.y, later.y), depths.y);
    if (depth < 0.5 * farAway && low < eyeDepth)
    {
      shadowed |= bitsBetween(shareOfLength(sight, max(low, 0.0) * sight.reach),
        shareOfLength(sight, max(min(high, eyeDepth), 0.0) * sight.reach), point);
    }
    before = depth;
    last = depths;
  }
  return litOf(sight, shadowed);
}
