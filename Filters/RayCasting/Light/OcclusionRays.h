// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Occlusion along single rays, traced in packets.
#ifndef penumbra_OcclusionRays_h
#define penumbra_OcclusionRays_h

#include "Embree/RayScene.h"
#include "Shading/DistanceFalloff.h"
#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro, which tests need

namespace penumbra
{

class VTKPENUMBRAFILTERSRAYCASTING_EXPORT OcclusionRays
{
public:
  static constexpr int PacketSize = 16;

  /// `rays` must outlive this object. `falloff` is in scene units. The mean of many rays is estimated
  /// to `tolerance`.
  OcclusionRays(const RayScene& rays, const DistanceFalloff& falloff, double tolerance);

  /// Returns the distance at which rays end, in scene units.
  float GetRadius() const { return this->Falloff.Radius; }

  /// Computes the occlusion along PacketSize rays, in [0, 1]; those with Near > Far are inactive. Adds the
  /// number of rays that were traced beyond the first hits to `additional`.
  void Trace(const Ray* rays, float* values, long long& additional) const;

private:
  const RayScene& Rays;
  DistanceFalloff Falloff;
  bool Translucent;
  float Cut; ///< transmittance at which rays end
};

}
#endif
