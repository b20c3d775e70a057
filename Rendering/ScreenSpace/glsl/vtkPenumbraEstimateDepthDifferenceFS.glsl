// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The depth-difference kernel [ISAO eq. 2; Kachanov, Zuev]. It samples points in the sphere around
// the surface point. A point that lies d radii behind the visible surface counts 1 / (1 + d^2).
// Departures: the offsets are reflected into the hemisphere, because otherwise an open plane would
// have an occlusion of one half; d is relative to the radius, so that the image does not depend on
// the unit of length. The kernel has no D(t): the gain was fitted to D = 1.
//VTK::Penumbra::HemisphereLib

// Scale of the estimate that minimizes the RMSE to traced rays, found with
// `./penumbra benchmark ambient-occlusion --only accuracy`.
const float gain = 0.9;

float occlusionAt(SurfacePoint point, int pointCount)
{
  float sum = 0.0;
  int i = 0;
  do
  {
    vec4 xi = pixelSample(i, point.pixel);
    float angle = 2.0 * pi * xi.x;
    float height = 2.0 * xi.z - 1.0;
    vec3 offset = vec3(sqrt(1.0 - height * height) * vec2(cos(angle), sin(angle)), height);
    offset *= sign(dot(offset, point.normal)) * pow(xi.y, 1.0 / 3.0);
    float behind = depthBehind(point, point.position + offset);
    sum += behind > 1e-4 ? 1.0 / (1.0 + behind * behind) : 0.0;
    ++i;
  } while (i < pointCount);
  return gain * sum / float(pointCount);
}
