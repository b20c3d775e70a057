// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Tiles whose pixels show parts of many small surfaces, such as points as spheres. Neighboring sites have too
// little in common to be joined, so that the samples of pixels are lit one by one.
#ifndef penumbra_ScatteredTiles_h
#define penumbra_ScatteredTiles_h

#include "LightRays.h"
#include "Sampling/SampleLight.h"

#include <cstdint>

namespace penumbra
{

/// Returns true if the tile with the first pixel `low` is scattered: most camera rays that hit a surface do not
/// hit the same site as one two pixels beside them. Traces camera rays in a few of its pixels. Returns false with
/// translucent surfaces, shafts or penumbrae.
bool IsScattered(const CameraRayTracer& tracer, glm::ivec2 low, RayCounts& counts);

/// Samples of pixels of such tiles.
template <int N>
class LitSamples
{
public:
  /// `uniformLight`: see LightTerms::ComputeChange(). The other arguments must outlive this object.
  LitSamples(const CameraRayTracer& tracer, const LightRays<N>& source, float uniformLight);

  /// SampleLight::TraceSamples() with RaysOfLitSample rays from the hit of each camera ray.
  void Trace(std::uint32_t seed, std::uint32_t first, const glm::dvec2* points,
    SampleLight::Packet& packet, RayCounts& counts) const;

private:
  using Value = typename LightTerms<N>::Value;

  /// Adds the values of one ray from each hit. `first`: index of the first direction.
  void AddRays(std::uint32_t seed, std::uint32_t first, const SampleLight::Packet& packet,
    Value* sums, RayCounts& counts) const;

  const CameraRayTracer& Tracer;
  const LightRays<N>& Source;
  const float UniformLight;
};

}
#endif
