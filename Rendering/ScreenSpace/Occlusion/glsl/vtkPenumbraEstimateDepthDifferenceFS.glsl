// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The depth-difference kernel [ISAO eq. 2; Kachanov, Zuev]: points around the surface point; each one
// behind what the eye sees counts 1 / (1 + d^2), d how far behind, in radii.
// Departures: the offsets are reflected into the hemisphere, or an open plane would be half dark; d is
// relative to the radius, or the picture would change with the unit of length. It has no D(t): the
// gain was fitted to D = 1.
//VTK::Penumbra::HemisphereLib

const float gain = 0.9; // measured: ./penumbra benchmark ambient-occlusion --only accuracy

float occlusionAt(SurfacePoint point)
{
  float sum = 0.0;
  for (int i = 0; i < sampleCount; ++i)
  {
    vec4 xi = pixelSample(i, point.pixel);
    float angle = 2.0 * pi * xi.x;
    float height = 2.0 * xi.z - 1.0;
    vec3 way = vec3(sqrt(1.0 - height * height) * vec2(cos(angle), sin(angle)), height);
    way *= sign(dot(way, point.normal)) * pow(xi.y, 1.0 / 3.0);
    float behind = depthBehind(point, point.position + way);
    sum += behind > 1e-4 ? 1.0 / (1.0 + behind * behind) : 0.0;
  }
  return gain * sum / float(sampleCount);
}
