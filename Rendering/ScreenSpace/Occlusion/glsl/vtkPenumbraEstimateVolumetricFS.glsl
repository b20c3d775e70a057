// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The volumetric kernel [TSSAO eq. 3, 14; Ritschel]: points in the hemisphere, directions distributed
// as the cosine, distances evenly; a point that the eye does not see counts as blocked. With a thick
// occluder at distance t a point is blocked with probability 1 - t: it estimates D(t) = 1 - t.
// Departures: eq. 14 is printed with misprints, see Documentation/methods/Kernels.md; the directions are
// cosine distributed already, so the cosine of eq. 3 is not applied again.
//VTK::Penumbra::HemisphereLib

float occlusionAt(SurfacePoint point)
{
  mat3 frame = frameOf(point.normal);
  float sum = 0.0;
  for (int i = 0; i < sampleCount; ++i)
  {
    vec4 xi = pixelSample(i, point.pixel);
    float angle = 2.0 * pi * xi.x;
    vec3 way = vec3(sqrt(1.0 - xi.z) * vec2(cos(angle), sin(angle)), sqrt(xi.z));
    vec3 position = point.position + xi.y * (frame * way);
    sum += depthBehind(point, position) > 1e-4 ? 1.0 : 0.0;
  }
  return sum / float(sampleCount);
}
