// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Finds the sites of the pixels of a block and traces rays from them. Every ray starts at a
// point of its own in the pixel, so that a site represents the mean of its pixel.
#ifndef penumbra_SiteSampler_h
#define penumbra_SiteSampler_h

#include "DirectionGuide.h"
#include "LightConstants.h"
#include "LightRays.h"
#include "Sampling/CameraRayTracer.h"
#include "Shading/OwenSobolSequence.h"
#include "SiteGrid.h"

#include <array>
#include <cstdint>
#include <vector>

namespace penumbra
{

template <int N>
class SiteSampler
{
public:
  static constexpr int Side = DirectionBlockSide;
  static constexpr int Cells = Side * Side;

  SiteSampler(const CameraRayTracer& tracer, const LightRays<N>& rays);

  /// Finds the sites of the pixels of the block whose lower left pixel is `first`, with FirstSiteRays
  /// rays in each.
  void FindSites(glm::ivec2 first);

  /// Adds samples to the pixels of the block, from `grid`, until each has its target.
  void AddSamples(glm::ivec2 first, const SiteGrid<N>& grid);

  const std::vector<LightSite<N>>& GetSites(int cell) const { return this->Sites[cell]; }
  const LightPixel& GetPixel(int cell) const { return this->Pixels[cell]; }
  /// Returns the guide that follows from the rays of FindSites().
  DirectionGuide MakeGuide() const { return DirectionGuide(this->Strengths); }

  /// Returns the pixel of a cell relative to the first one of the block, in Morton order.
  static glm::ivec2 GetOffset(int cell);

  long long CameraRays = 0;
  long long TracedRays = 0;
  RayCounts Counts;

private:
  /// A camera ray, and the rays that start at its hits.
  struct Request
  {
    int Cell;
    int Half;
    std::uint32_t Index;    ///< of its point, in the sequence of the half
    std::uint32_t FirstRay; ///< indices of the directions, in the sequence of the half
    std::uint32_t Rays;
    bool IsShaded;           ///< its color counts
    std::uint32_t Count = 1; ///< of the camera rays of the half that are added with it
  };

  void Begin(glm::ivec2 first);
  /// Adds the samples [from, to) of `added` ones of each half that follow `before`.
  void AddRequests(
    int cell, std::uint32_t before, std::uint32_t from, std::uint32_t to, std::uint32_t added);
  /// Returns the number of rays that start at a hit after the first round.
  std::uint32_t CountRaysOfHit(int cell) const;
  void TraceRequests(bool createsSites);
  float ChooseLayer(const Request& request) const;
  void AddLayer(const Request& request, const LitLayer& layer, std::uint16_t number,
    glm::vec3 color, bool createsSites);
  LightSite<N>* FindSite(
    int cell, const LitLayer& layer, std::uint16_t number, float footprint, bool mustFind);
  void QueueRays(
    const Request& request, std::size_t site, int half, std::uint32_t count, const LitLayer& layer);
  void Flush();
  bool IsComplex(int cell) const;

  const CameraRayTracer& Tracer;
  const LightRays<N>& Source;
  const std::uint32_t PartSamples; ///< of a pixel with several sites
  glm::ivec2 First{ 0 };
  std::uint32_t Seed = 0;
  std::array<OwenSobolSequence, Halves> Directions; ///< sequences of the block
  std::array<OwenSobolSequence, Halves> Lights;
  std::vector<LightSite<N>> Sites[Cells];
  LightPixel Pixels[Cells];
  std::vector<Request> Requests;
  std::vector<LitLayer> Layers[CameraRayTracer::PacketSize];

  DirectionGuide Guide;
  DirectionGuide::Sums Strengths; ///< of all rays
  LightPacket<N> Packet;
  struct RayOwner
  {
    int Cell;
    std::size_t Site;
    int Half;
    glm::vec2 At; ///< point of the unit square that chose its direction
  };
  RayOwner Owners[LightRays<N>::PacketSize];
};

}
#endif
