// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The patch kernel [TSSAO eq. 12-13; Fox, Compton]. Every visible surface point within the radius
// is a small patch that blocks the cosine of its direction divided by its distance. It keeps fine
// detail with large radii and shows the facets of coarse meshes. Departure: patches beyond the
// radius have no weight. The kernel has no D(t): the gain was fitted to D = 1.

// Scale of the estimate that minimizes the RMSE to traced rays, found with
// `./penumbra benchmark ambient-occlusion --only accuracy`.
const float gain = 0.6;

// Lower bound of the distance in the denominator, in radii: epsilon of eq. 12.
const float minimumDistance = 0.05;

float occlusionAt(SurfacePoint point, int pointCount)
{
  float sum = 0.0;
  int i = 0;
  do
  {
    vec4 xi = pixelSample(i, point.pixel);
    float angle = 2.0 * pi * xi.x;
    vec2 offset = sqrt(xi.y) * vec2(cos(angle), sin(angle));
    vec3 delta = eyePositionAt(point.pixel + radiusInPixels(point, offset)) - point.position;
    float distance = length(delta);
    float cosine = dot(delta, point.normal) / max(distance, 1e-6);
    sum += distance < 1.0 ? max(cosine, 0.0) / max(distance, minimumDistance) : 0.0;
    ++i;
  } while (i < pointCount);
  return gain * sum / float(pointCount);
}
