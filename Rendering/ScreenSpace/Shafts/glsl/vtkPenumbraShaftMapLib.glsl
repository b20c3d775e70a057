// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lit fraction of a view ray, from a shadow map of the light. The ray is lit outside of the map and
// in front of it. Inside, steps of equal in-scattering are compared with the depths of 2 x 2 texels
// each (percentage closer filtering).
uniform sampler2DShadow shadowMap;
uniform mat4 eyeToMap; // from eye coordinates to the map, which is the unit cube; homogeneous
uniform int steps;     // comparisons per ray

// Clips a span of the ray to the part on which start + length * slope is not negative.
vec2 clipSpan(vec2 span, float start, float slope)
{
  float root = -start / (abs(slope) > 1e-20 ? slope : 1e-20);
  return slope > 0.0 ? vec2(max(span.x, root), span.y)
                     : vec2(span.x, slope < 0.0 ? min(span.y, root) : start < 0.0 ? span.x : span.y);
}

// Part of the ray inside the sides of the map and behind its near plane.
vec2 clipToMap(vec2 span, vec4 start, vec4 slope)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    span = clipSpan(span, start[axis], slope[axis]);
  }
  for (int axis = 0; axis < 2; ++axis)
  {
    span = clipSpan(span, start.w - start[axis], slope.w - slope[axis]);
  }
  return vec2(span.x, max(span.x, span.y));
}

// A pixel is interpolated from four texels. Their samples are a quarter of a step apart.
float sampleOffset(vec2 pixel)
{
  vec2 odd = mod(floor(pixel), 2.0);
  return 0.125 + 0.5 * odd.x + 0.25 * abs(odd.x - odd.y);
}

float estimateLitFraction(ViewRay ray, vec2 pixel, float eyeDepth)
{
  vec4 start = eyeToMap * vec4(ray.start, 1.0);
  vec4 slope = eyeToMap * vec4(ray.direction, 0.0);
  vec2 span = clipToMap(vec2(ray.begin, ray.end), start, slope);
  float first = cdfOfLength(ray, span.x);
  float stride = max(cdfOfLength(ray, span.y) - first, 0.0) / float(steps);
  float offset = sampleOffset(pixel);
  float shadowed = 0.0;
  int count = stride > 0.0 ? steps : 0;
  int i = 0;
  do
  {
    float cdf = first + (float(i) + offset) * stride;
    vec4 point = start + lengthOfCdf(ray, cdf) * slope;
    vec3 position = point.xyz / point.w;
    float lit = texture(shadowMap, vec3(position.xy, clamp(position.z, 0.0, 1.0)));
    shadowed += (1.0 - lit) * inScatteringWeight(ray, cdf);
    ++i;
  } while (i < count);
  shadowed = count > 0 ? shadowed : 0.0;
  return clamp(1.0 - shadowed * stride / max(meanInScatteringWeight(ray), 1e-30), 0.0, 1.0);
}
