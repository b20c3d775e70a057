//VTK::System::Dec
//VTK::Output::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// New samples join those of earlier frames [TSSAO eq. 4-9]. The history is fetched where the point
// was in the previous picture, bilinearly, each of the four texels only if it lies on the plane
// through the point: so a surface seen at a grazing angle keeps its history (eq. 8 alone would
// reject it) and what just came into sight starts afresh.
//VTK::Penumbra::ViewLib
//VTK::Penumbra::SurfaceLib
//VTK::Penumbra::EstimateLib
//VTK::Penumbra::SoundLib
uniform sampler2D history;         // r: sum, g: number of samples
uniform sampler2D previousEyeDepths;
uniform mat4 toPreviousEye;        // eye coordinates to those of the previous picture
uniform vec4 previousPixelToEye;
uniform vec2 previousPixelSize;    // 1 / size of the previous picture
uniform float newSamples;
uniform float maximumWeight;
uniform float weightCap;           // no more of the history counts in this frame
uniform float depthTolerance;      // relative, eq. 8

// Nor is history kept from farther off the plane than so many radii: occlusion differs there. Measured,
// `./penumbra benchmark ambient-occlusion --only noise`.
const float farthestOff = 0.08;

// What a sample of a neighbour counts: next to nothing, where there is anything else.
const float borrowed = 0.01;

vec2 previousPlane(vec2 pixel)
{
  return previousPixelToEye.xy * pixel + previousPixelToEye.zw;
}

vec2 previousPixel(vec3 position)
{
  vec2 plane = position.xy / mix(1.0, -position.z, perspective);
  return (plane - previousPixelToEye.zw) / previousPixelToEye.xy;
}

float previousDepthAt(vec2 pixel)
{
  return texture(previousEyeDepths, pixel * previousPixelSize).r;
}

// Whether a pixel lies in a picture, given one by the picture's size.
bool isInside(vec2 pixel, vec2 sizeOfPixel)
{
  vec2 at = pixel * sizeOfPixel;
  return all(greaterThan(at, vec2(0.0))) && all(lessThan(at, vec2(1.0)));
}

// The mean of the four nearest pixels of the history that lie on the plane through the point.
vec2 keptHistory(vec3 position, vec3 normal)
{
  vec2 at = previousPixel(position);
  vec2 corner = floor(at - 0.5) + 0.5;
  vec2 share = at - corner;
  // A pixel sees the plane at the depth d with d * perDepth = rest; both are linear over the picture, so
  // that no pixel needs a division.
  vec2 slope = normal.xy * previousPixelToEye.xy;
  float aside = dot(normal.xy, previousPlane(corner));
  float offset = dot(normal, position);
  vec2 sum = vec2(0.0);
  float weights = 1e-6;
  for (int i = 0; i < 4; ++i)
  {
    vec2 tap = vec2(float(i % 2), float(i / 2));
    vec2 near = mix(1.0 - share, share, tap);
    float tapAside = aside + dot(slope, tap);
    float perDepth = perspective * tapAside - normal.z;
    float rest = offset - (1.0 - perspective) * tapAside;
    float found = previousDepthAt(corner + tap);
    float allowed =
      depthTolerance < 1.0 ? min(depthTolerance * abs(rest), farthestOff) : abs(rest);
    bool same = abs(found * perDepth - rest) < allowed;
    float weight = same ? near.x * near.y : 0.0;
    vec2 fetched = texture(history, (corner + tap) * previousPixelSize).rg;
    vec2 known = soundHistory(fetched);
    weight = known == fetched ? weight : 0.0;
    sum += weight * known;
    weights += weight;
  }
  return isInside(at, previousPixelSize) ? sum / weights : vec2(0.0);
}

//VTK::Penumbra::MotionLib
//VTK::Penumbra::ValidationLib

void main()
{
  SurfacePoint point = surfaceAt(gl_FragCoord.xy);
  mat4 motion = motionOf(actorAt(point.pixel));
  vec3 before = (motion * vec4(point.position, 1.0)).xyz;
  vec2 kept = keptHistory(before, mat3(motion) * point.normal);
  float weight = min(kept.g, weightCap);
  weight = min(weight, neighbourTrust(point, before));
  float estimate = estimateAt(point);
  bool isBorrowed = estimate < -0.5; // -1 - a mean: vtkPenumbraOcclusionEstimator::Estimate()
  float samples = isBorrowed ? borrowed * newSamples : newSamples;
  estimate = isBorrowed ? -1.0 - estimate : estimate;
  weight = min(weight, max(maximumWeight - newSamples, 0.0));
  kept *= weight / max(kept.g, 1e-6);
  gl_FragData[0] = vec4(kept + soundSamples(estimate, samples), 0.0, 1.0);
}
