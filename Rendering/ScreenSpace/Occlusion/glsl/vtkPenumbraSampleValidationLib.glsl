// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Sample validation if something besides the camera may have moved: limits the weight of a point's
// history by the change of its offsets to neighboring points. Departure from [TSSAO eq. 9]: offsets
// instead of distances, whose change is of second order if a neighbor moves across the offset.
uniform float invalidationWeight; // lower bound of the limit, in samples
uniform float propsChanged;       // 1: props were added or removed; 0: props at most moved

// Number of neighbors sampled per pixel. This and the other constants were measured by the tests
// OcclusionInMotion.
const int neighborCount = 16;

// The same in a frame in which props were added or removed. With 16, some pixels miss a removed prop
// and keep its occlusion.
const int neighborCountOnPropChange = 48;

// Change of depth per distance across the view up to which a surface between pixel centers does not
// count as moved.
const float maximumSlopeOfNeighbors = 3.0;

// Returns the largest change of the offsets from the point to a disk of neighbors, in radii, relative
// to the surface of the point.
float neighborOffsetChange(SurfacePoint point, vec3 before)
{
  float rotation =
    6.2831853 * fract(52.9829189 * fract(dot(floor(point.pixel), vec2(0.06711056, 0.00583715))));
  float centerActor = actorAt(point.pixel);
  mat4 centerMotion = actorMotion(centerActor);
  float pixelWidth = pixelToEye.x * mix(1.0, -point.position.z, perspective);
  float change = 0.0;
  int count = propsChanged > 0.5 ? neighborCountOnPropChange : neighborCount;
  for (int i = 0; i < count; ++i)
  {
    float angle = rotation + 2.3999632 * float(i); // the golden angle
    float ringRadius = sqrt((float(i) + 0.5) / float(count));
    vec2 offset = ringRadius * vec2(cos(angle), sin(angle));
    vec2 pixel = point.pixel +
      pixelOffsetOnPlane(offset / mix(1.0, -point.position.z, perspective));
    vec3 now = eyePositionAt(pixel);
    float actor = actorAt(pixel);
    vec3 reprojected = (actorMotion(actor) * vec4(now, 1.0)).xyz;
    vec2 previousAt = previousPixel(reprojected);
    float depth = previousDepthAt(previousAt);
    vec3 previousPosition =
      vec3(previousPlane(previousAt), -1.0) * vec3(vec2(mix(1.0, depth, perspective)), depth);
    // Offsets within a rigid body do not change, except by sampling. This requires that the
    // neighbor was visible in the previous frame.
    vec3 asCenter = (centerMotion * vec4(now, 1.0)).xyz;
    bool rigid = min(actor, centerActor) > 0.5 && distance(asCenter, reprojected) < 1e-3 &&
      abs(depth + reprojected.z) < depthTolerance * depth;
    previousPosition = rigid ? reprojected : previousPosition;
    float span = min(length(now - point.position), 1.0);
    float spanBefore = min(length(previousPosition - before), 1.0);
    // Of a neighbor that is or was outside of the radius, only the part inside counts; at outlines, it
    // may be another surface between the centers of pixels.
    float moved = max(span, spanBefore) < 1.0 ? distance(previousPosition, asCenter)
                                              : 0.3 * abs(span - spanBefore);
    // The previous depth is that of the center of a pixel.
    float offCenter = rigid ? 0.0 : distance(previousAt, floor(previousAt) + 0.5);
    moved -= maximumSlopeOfNeighbors * offCenter * pixelWidth;
    bool isVisible = isInside(pixel, pixelSize) && isInside(previousAt, previousPixelSize);
    // A new prop can be as far away as the surface that it hides, so offsets alone do not reveal it.
    float replaced =
      min(span, spanBefore) < 1.0 ? propsChanged * length(previousPosition - reprojected) : 0.0;
    change = max(change, isVisible ? max(moved, replaced) : 0.0);
  }
  return change;
}

// Returns the upper bound of the weight of the history: maximumWeight for changes below 0.005 radii,
// invalidationWeight above 0.03 radii.
float historyWeightLimit(SurfacePoint point, vec3 before)
{
  float confidence = 1.0 - smoothstep(0.005, 0.03, neighborOffsetChange(point, before));
  return mix(invalidationWeight, maximumWeight, confidence);
}
