//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Adds new samples to the reprojected history [TSSAO eq. 4-9]. The history is interpolated
// bilinearly at the position of the point in the previous frame. Each of the four texels counts
// only if it lies on the tangent plane of the point. Surfaces at grazing angles keep their history,
// which eq. 8 alone would reject, and disoccluded pixels start without history.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::SurfaceLib
//VTK::Penumbra::EstimateLib
//VTK::Penumbra::FiniteValuesLib
uniform sampler2D history;         // r: sum, g: number of samples
uniform sampler2D previousEyeDepths;
uniform mat4 toPreviousEye;        // from eye coordinates to those of the previous frame
uniform vec4 previousPixelToEye;
uniform float previousPixelSkew;
uniform vec2 previousPixelSize;    // 1 / size of the previous frame
uniform float growingHistoryWeight; // weight below which a history is short
uniform float settledHistoryWeight; // weight from which on a history is settled
uniform float maximumWeight;       // upper bound of the weight of all samples
uniform float weightCap;           // upper bound of the weight of the history in this frame
uniform float depthTolerance;      // maximum relative difference in depth, eq. 8
uniform float imageOnly;           // 1: occluders outside of the image are unknown; 0: they are known

// Maximum distance of a history texel from the tangent plane, in radii: occlusion differs farther
// away. Found with `./penumbra benchmark ambient-occlusion --only noise`.
const float maximumPlaneDistance = 0.08;

// Distance from the edge of the image, in radii, that counts as none.
const float minimumEdgeDistance = 0.01;

vec2 previousPlane(vec2 pixel)
{
  return previousPixelToEye.xy * pixel + previousPixelToEye.zw +
    vec2(previousPixelSkew * pixel.y, 0.0);
}

vec2 previousPixel(vec3 position)
{
  vec2 plane = position.xy / mix(1.0, -position.z, perspective) - previousPixelToEye.zw;
  float y = plane.y / previousPixelToEye.y;
  return vec2((plane.x - previousPixelSkew * y) / previousPixelToEye.x, y);
}

float previousDepthAt(vec2 pixel)
{
  return texture(previousEyeDepths, pixel * previousPixelSize).r;
}

// Returns true if a pixel lies in an image. `sizeOfPixel`: 1 / size of the image.
bool isInside(vec2 pixel, vec2 sizeOfPixel)
{
  vec2 at = pixel * sizeOfPixel;
  return all(greaterThan(at, vec2(0.0))) && all(lessThan(at, vec2(1.0)));
}

// Returns the weighted mean of the four nearest history texels that lie on the tangent plane of the
// point.
vec2 sampleHistory(vec3 position, vec3 normal)
{
  vec2 at = previousPixel(position);
  vec2 corner = floor(at - 0.5) + 0.5;
  vec2 fraction = at - corner;
  // At a pixel, the depth d of the plane satisfies d * perDepth = planeDepth. Both are linear
  // functions of the pixel, so that no division is needed.
  vec2 planeSlope =
    normal.xy * previousPixelToEye.xy + vec2(0.0, previousPixelSkew * normal.x);
  float planeDot = dot(normal.xy, previousPlane(corner));
  float planeOffset = dot(normal, position);
  vec2 sum = vec2(0.0);
  float weights = 1e-6;
  for (int i = 0; i < 4; ++i)
  {
    vec2 tap = vec2(float(i % 2), float(i / 2));
    vec2 bilinear = mix(1.0 - fraction, fraction, tap);
    float tapPlaneDot = planeDot + dot(planeSlope, tap);
    float perDepth = perspective * tapPlaneDot - normal.z;
    float planeDepth = planeOffset - (1.0 - perspective) * tapPlaneDot;
    float tapDepth = previousDepthAt(corner + tap);
    float allowed =
      depthTolerance < 1.0 ? min(depthTolerance * abs(planeDepth), maximumPlaneDistance)
                           : abs(planeDepth);
    bool onPlane = abs(tapDepth * perDepth - planeDepth) < allowed;
    float weight = onPlane ? bilinear.x * bilinear.y : 0.0;
    vec2 fetched = texture(history, (corner + tap) * previousPixelSize).rg;
    vec2 valid = finiteHistory(fetched);
    weight = valid == fetched ? weight : 0.0;
    sum += weight * valid;
    weights += weight;
  }
  return isInside(at, previousPixelSize) ? sum / weights : vec2(0.0);
}

// Returns the vector to which a motion maps the area vector of a piece of surface: its direction is the
// normal, its length the area. Motions may scale lengths, differently along each axis.
vec3 movedArea(mat4 motion, vec3 area)
{
  vec3 x = motion[0].xyz;
  vec3 y = motion[1].xyz;
  vec3 z = motion[2].xyz;
  vec3 acrossX = cross(y, z);
  vec3 moved = area.x * acrossX + area.y * cross(z, x) + area.z * cross(x, y);
  return dot(x, acrossX) < 0.0 ? -moved : moved; // a mirrored surface keeps its outside
}

// Returns the number of pixels that a piece of surface covers, times the size of a pixel on the plane at
// depth 1; negative if the surface faces away.
float coveredPixels(vec3 position, vec3 area)
{
  float depth = mix(1.0, -position.z, perspective);
  vec3 toEye = mix(vec3(0.0, 0.0, 1.0), -position, perspective);
  return dot(area, toEye) / (depth * depth * depth);
}

// Returns the number of texels of the history per pixel of this frame on the surface of a point.
float historyTexelsPerPixel(SurfacePoint point, vec3 before, vec3 areaBefore)
{
  float sizeRatio =
    (pixelToEye.x * pixelToEye.y) / (previousPixelToEye.x * previousPixelToEye.y);
  return sizeRatio * coveredPixels(before, areaBefore) /
    max(coveredPixels(point.position, point.normal), 1e-9);
}

// Returns the distance of a point from the edge of an image, in radii, at most 1: occluders that are farther
// away have no effect. `pixelWidth`: at depth 1.
float edgeDistance(vec2 pixel, vec2 sizeOfPixel, vec2 pixelWidth, float depth)
{
  vec2 at = pixel * sizeOfPixel;
  vec2 inside = min(at, 1.0 - at) * abs(pixelWidth / sizeOfPixel) * mix(1.0, depth, perspective);
  return clamp(min(inside.x, inside.y), minimumEdgeDistance, 1.0);
}

// Returns the part of the history of a point that counts. It did not see the occluders outside of the previous
// image, so it loses weight as the point moves away from the edge, by the ratio of the distances. In a
// slow motion, samples lose the same weight in total, but new ones replace them.
float historyInsideImage(SurfacePoint point, vec3 before)
{
  float last = edgeDistance(
    previousPixel(before), previousPixelSize, previousPixelToEye.xy, -before.z);
  float now = edgeDistance(point.pixel, pixelSize, pixelToEye.xy, -point.position.z);
  return mix(1.0, min(last / now, 1.0), imageOnly);
}

//VTK::Penumbra::ActorMotionLib
//VTK::Penumbra::SampleValidationLib

void main()
{
  SurfacePoint point = surfaceAt(gl_FragCoord.xy);
  mat4 motion = actorMotion(actorAt(point.pixel));
  vec3 before = (motion * vec4(point.position, 1.0)).xyz;
  vec3 areaBefore = movedArea(motion, point.normal);
  vec2 reprojected = sampleHistory(before, normalize(areaBefore));
  float weight = min(reprojected.g, weightCap);
  // Pixels share the samples of a texel that covers several of them.
  weight *= clamp(historyTexelsPerPixel(point, before, areaBefore), 0.0, 1.0);
  weight *= reprojected.g > 0.0 ? historyInsideImage(point, before) : 0.0;
  weight = min(weight, historyWeightLimit(point, before));
  // Samples are spent where history is short: at disoccluded pixels and next to moved surfaces.
  int historyLength = weight < settledHistoryWeight ? growingHistory : settledHistory;
  historyLength = weight < growingHistoryWeight ? shortHistory : historyLength;
  float newSamples = newSamplesAt(point, historyLength);
  float estimate = estimateAt(point, historyLength);
  weight = min(weight, max(maximumWeight - newSamples, 0.0));
  reprojected *= weight / max(reprojected.g, 1e-6);
  gl_FragData[0] = vec4(reprojected + finiteSamples(estimate, newSamples), 0.0, 1.0);
}
