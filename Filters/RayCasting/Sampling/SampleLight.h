// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Ambient occlusion and indirect light of single camera rays, for pixels whose light is not estimated
// together with that of their neighbors.
#ifndef penumbra_SampleLight_h
#define penumbra_SampleLight_h

#include "CameraRayTracer.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

class SampleLight
{
public:
  SampleLight() = default;
  virtual ~SampleLight() = default;
  SampleLight(const SampleLight&) = delete;
  SampleLight& operator=(const SampleLight&) = delete;

  /// Returns true if the samples of a pixel are lit one by one.
  virtual bool LightsSamples(glm::ivec2 pixel) const = 0;

  /// Returns the accepted RMSE that light adds to a tile.
  virtual double GetTolerance() const = 0;

  /// Light of PacketSize samples.
  struct Packet
  {
    Sample Samples[CameraRayTracer::PacketSize];
    std::vector<LitLayer> Layers[CameraRayTracer::PacketSize];
    float Occlusion = 0.f; ///< sum over the samples that show a surface
    int Surfaces = 0;      ///< number of these samples
  };

  /// CameraRayTracer::TracePacket() with light. `first` is the index of the first of the points in the
  /// sequence of a pixel, whose seed is `seed`.
  virtual void TraceSamples(std::uint32_t seed, std::uint32_t first, const glm::dvec2* points,
    Packet& packet, RayCounts& counts) const = 0;
};

}
#endif
