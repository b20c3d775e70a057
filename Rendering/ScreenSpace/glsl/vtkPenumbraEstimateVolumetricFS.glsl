// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The volumetric kernel [TSSAO eq. 3, 14; Ritschel]. It samples points in the hemisphere, with
// cosine-distributed directions and uniform distances. A point that is not visible from the camera
// counts as blocked. With a thick occluder at distance t a point is blocked with probability 1 - t,
// so the kernel estimates D(t) = 1 - t. Departures: misprints of eq. 14 are corrected, see
// Documentation/methods/Kernels.md; the cosine of eq. 3 is not applied again, because the
// directions are already cosine-distributed.
//VTK::Penumbra::HemisphereLib

float occlusionAt(SurfacePoint point, int pointCount)
{
  mat3 frame = tangentFrame(point.normal);
  float sum = 0.0;
  int i = 0;
  do
  {
    vec4 xi = pixelSample(i, point.pixel);
    float angle = 2.0 * pi * xi.x;
    vec3 direction = vec3(sqrt(1.0 - xi.z) * vec2(cos(angle), sin(angle)), sqrt(xi.z));
    vec3 position = point.position + xi.y * (frame * direction);
    sum += depthBehind(point, position) > 1e-4 ? 1.0 : 0.0;
    ++i;
  } while (i < pointCount);
  return sum / float(pointCount);
}
