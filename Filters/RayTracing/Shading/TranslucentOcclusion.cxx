// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TranslucentOcclusion.h"

#include "RayTracingConstants.h"
#include "Shading.h"
#include "Surface.h"

#include <algorithm>

namespace penumbra
{
bool HasTranslucentOccluders(const std::vector<Surface>& surfaces)
{
  return std::any_of(surfaces.begin(), surfaces.end(),
    [](const Surface& surface) { return !surface.IsLineOrPoint && surface.IsTranslucent(); });
}

float ComputeOcclusionCut(double tolerance)
{
  return static_cast<float>(std::min(OcclusionCutFraction * tolerance, MaximumOcclusionCut));
}

float TraceTranslucentOcclusion(const RayScene& rays, Ray ray, Hit hit,
  const DistanceFalloff& falloff, float cut, long long& count)
{
  float occlusion = 0.f;
  float transmittance = 1.f;
  for (int layer = 0; hit.IsHit() && layer < MaximumLayers; ++layer)
  {
    const float opacity = Shading::ComputeOpacity(rays, hit, ray);
    occlusion += transmittance * opacity * falloff.Evaluate(hit.Distance);
    transmittance *= 1.f - opacity;
    if (transmittance < cut)
    {
      break;
    }
    ray = ContinueBehind(ray, hit);
    hit = SkipLinesAndPoints(rays, ray, rays.Intersect(ray));
    ++count;
  }
  return occlusion;
}

}
