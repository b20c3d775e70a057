// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The patch kernel [TSSAO eq. 12-13; Fox, Compton]: every visible surface point nearby is a small
// patch that blocks by the cosine of its direction over its distance. Keeps fine detail under wide
// kernels, and shows the facets of coarse meshes.
// Departure: patches beyond the radius do not count. It has no D(t): the gain was fitted to D = 1.

const float gain = 0.6;     // measured: ./penumbra benchmark ambient-occlusion --only accuracy
const float nearest = 0.05; // eps of eq. 12, in radii

float occlusionAt(SurfacePoint point)
{
  vec2 reach = radiusInPixels(point);
  float sum = 0.0;
  for (int i = 0; i < sampleCount; ++i)
  {
    vec4 xi = pixelSample(i, point.pixel);
    float angle = 2.0 * pi * xi.x;
    vec2 offset = sqrt(xi.y) * vec2(cos(angle), sin(angle));
    vec3 way = eyePositionAt(point.pixel + offset * reach) - point.position;
    float distance = length(way);
    float cosine = dot(way, point.normal) / max(distance, 1e-6);
    sum += distance < 1.0 ? max(cosine, 0.0) / max(distance, nearest) : 0.0;
  }
  return gain * sum / float(sampleCount);
}
