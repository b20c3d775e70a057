// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionRays.h"

#include "Shading/TranslucentOcclusion.h"

#include <algorithm>

namespace penumbra
{

OcclusionRays::OcclusionRays(const RayScene& rays, const DistanceFalloff& falloff, double tolerance)
  : Rays(rays),
    Falloff(falloff),
    Translucent(HasTranslucentOccluders(rays.GetScene())),
    Cut(ComputeOcclusionCut(tolerance))
{
}

// Without falloff, any hit suffices; otherwise the nearest hit is needed.
void OcclusionRays::Trace(const Ray* rays, float* values, long long& additional) const
{
  if (this->Falloff.IsConstant() && !this->Translucent)
  {
    bool occluded[PacketSize];
    this->Rays.Occluded16(rays, occluded);
    std::copy(occluded, occluded + PacketSize, values);
    return;
  }
  Hit hits[PacketSize];
  this->Rays.Intersect16(rays, hits);
  for (int i = 0; i < PacketSize; ++i)
  {
    const Hit hit = SkipLinesAndPoints(this->Rays, rays[i], hits[i]);
    values[i] = this->Translucent
      ? TraceTranslucentOcclusion(this->Rays, rays[i], hit, this->Falloff, this->Cut, additional)
      : hit.IsHit() ? this->Falloff.Evaluate(hit.Distance)
                    : 0.f;
  }
}

}
