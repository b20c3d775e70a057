// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Where something besides the eye may have moved: how much of a point's history is still to be
// trusted, by the change of its distances to its neighbours [TSSAO eq. 9].
uniform float invalidationWeight; // no weight is pulled below this
uniform float propsChanged;       // 1: props have appeared or disappeared; 0: at most moved

const int neighbours = 8;

// In the one frame in which props have appeared or disappeared: with 8, pixels that miss the prop keep
// its occlusion.
const int neighboursOfChange = 48;

// How far the distances between the point and what surrounds it have changed, in radii: the largest
// of a ring of neighbours [TSSAO eq. 9].
float neighbourChange(SurfacePoint point, vec3 before)
{
  vec2 reach = 1.0 / (pixelToEye.xy * mix(1.0, -point.position.z, perspective));
  float turn = 6.2831853 * fract(52.9829189 * fract(dot(floor(point.pixel), vec2(0.06711056, 0.00583715))));
  float own = actorAt(point.pixel);
  float change = 0.0;
  int count = propsChanged > 0.5 ? neighboursOfChange : neighbours;
  for (int i = 0; i < count; ++i)
  {
    float angle = turn + 2.3999632 * float(i); // the golden angle
    float away = sqrt((float(i) + 0.5) / float(count));
    vec2 pixel = point.pixel + away * reach * vec2(cos(angle), sin(angle));
    vec3 now = eyePositionAt(pixel);
    float actor = actorAt(pixel);
    vec3 then = (motionOf(actor) * vec4(now, 1.0)).xyz;
    vec2 was = previousPixel(then);
    float depth = previousDepthAt(was);
    vec3 found = vec3(previousPlane(was), -1.0) * vec3(vec2(mix(1.0, depth, perspective)), depth);
    // Within a rigid body no distance changes, whatever pixels make of it: if only it was seen.
    bool rigid = actor > 0.5 && actor == own && abs(depth + then.z) < depthTolerance * depth;
    found = rigid ? then : found;
    float span = min(length(now - point.position), 1.0);
    float spanBefore = min(length(found - before), 1.0);
    bool seen = isInside(pixel, pixelSize) && isInside(was, previousPixelSize);
    // Another surface may be as far away as the one that was seen before it appeared.
    float replaced = min(span, spanBefore) < 1.0 ? propsChanged * length(found - then) : 0.0;
    change = max(change, seen ? max(abs(span - spanBefore), replaced) : 0.0);
  }
  return change;
}

// The weight up to which history counts: all of it below a hundredth of the radius of change, the
// least above a tenth.
float neighbourTrust(SurfacePoint point, vec3 before)
{
  float trust = 1.0 - smoothstep(0.01, 0.1, neighbourChange(point, before));
  return mix(invalidationWeight, maximumWeight, trust);
}
