// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SiteSampler.h"

#include "Execution/Vectorized.h"
#include "Shading/HemisphereSampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{
namespace
{

constexpr int PacketSize = CameraRayTracer::PacketSize;
/// Index of the first of the camera rays that only determine the parts of the sites.
constexpr std::uint32_t FirstPartIndex = 1u << 24;

/// Distance that corresponds to a difference of one layer, in pixels.
constexpr float OtherLayerDistance = 4.f;

/// Replaces the layers behind the first ones by one of them with their color. `random` in [0, 1) chooses it
/// with probabilities in proportion to their colors.
template <int N>
void MergeLayers(std::vector<LitLayer>& layers, float random)
{
  const auto weigh = [](glm::vec3 color, glm::vec3 reflectance) {
    const glm::vec3 part = N == 1 ? color : N == 3 ? reflectance : color + reflectance;
    return part.r + part.g + part.b;
  };
  glm::vec3 color(0.f);
  glm::vec3 reflectance(0.f);
  for (std::size_t i = MaximumSiteLayers; i < layers.size(); ++i)
  {
    color += layers[i].Color;
    reflectance += layers[i].Reflectance;
  }
  float rest = random * weigh(color, reflectance);
  std::size_t chosen = MaximumSiteLayers;
  for (; chosen + 1 < layers.size(); ++chosen)
  {
    rest -= weigh(layers[chosen].Color, layers[chosen].Reflectance);
    if (rest < 0.f)
    {
      break;
    }
  }
  layers[MaximumSiteLayers] = layers[chosen];
  layers[MaximumSiteLayers].Color = color;
  layers[MaximumSiteLayers].Reflectance = reflectance;
  layers.resize(MaximumSiteLayers + 1);
}

enum Sequences
{
  PixelPositions,
  Directions,
  MergedLayers,
  LightSamples,
};

/// Returns the number of samples that determine the parts of a pixel: a power of two.
std::uint32_t CountPartSamples(double tolerance)
{
  std::uint32_t samples = MaximumPartSamples;
  while (samples > MinimumPartSamples &&
    std::pow(tolerance / PartTolerance, 4.0 / 3.0) >= MaximumPartSamples / (0.75 * samples))
  {
    samples /= 2;
  }
  return samples;
}

/// Returns the place of a point among `count` points, whose indices begin at a multiple of `count`. A power of two of
/// points is in Morton order, so that the rays that start in a part of the pixel have consecutive directions.
std::uint32_t FindPlace(glm::vec2 at, std::uint32_t index, std::uint32_t count)
{
  if ((count & (count - 1)) != 0)
  {
    return index % count;
  }
  std::uint32_t place = 0;
  for (int axis = 0; count > 1; count /= 2, axis = 1 - axis)
  {
    at[axis] *= 2.f;
    const bool isUpper = at[axis] >= 1.f;
    at[axis] -= isUpper ? 1.f : 0.f;
    place = 2 * place + (isUpper ? 1 : 0);
  }
  return place;
}

/// Points of the unit square that choose the directions of the rays of a hit.
struct DirectionPoints
{
  float X[RaysOfHit];
  float Y[RaysOfHit];
};

PENUMBRA_VECTORIZED
void FindPoints(const OwenSobolSequence& sequence, std::uint32_t seed, std::uint32_t first,
  DirectionPoints& points)
{
  for (std::uint32_t i = 0; i < RaysOfHit; ++i)
  {
    const glm::vec2 at = sequence.At(OwenSobolSequence::ShuffleIndex(first + i, seed));
    points.X[i] = at.x;
    points.Y[i] = at.y;
  }
}

OwenSobolSequence MakeSequence(std::uint32_t seed, int half, Sequences kind)
{
  return OwenSobolSequence(MixBits(seed + 2u * static_cast<std::uint32_t>(kind) + half));
}

}

template <int N>
SiteSampler<N>::SiteSampler(const CameraRayTracer& tracer, const LightRays<N>& rays)
  : Tracer(tracer),
    Source(rays),
    PartSamples(CountPartSamples(rays.GetTolerance())),
    Directions{ OwenSobolSequence(0), OwenSobolSequence(0) },
    Lights(this->Directions)
{
}

template <int N>
glm::ivec2 SiteSampler<N>::GetOffset(int cell)
{
  glm::ivec2 offset(0);
  for (int bit = 0; bit < 3; ++bit)
  {
    offset.x |= (cell >> (2 * bit) & 1) << bit;
    offset.y |= (cell >> (2 * bit + 1) & 1) << bit;
  }
  return offset;
}

template <int N>
void SiteSampler<N>::Begin(glm::ivec2 first)
{
  const glm::ivec2 block = first / Side;
  this->First = first;
  this->Seed =
    MixBits(static_cast<std::uint32_t>(block.x) + MixBits(static_cast<std::uint32_t>(block.y))) *
    8u;
  for (int half = 0; half < Halves; ++half)
  {
    this->Directions[half] = MakeSequence(this->Seed, half, Sequences::Directions);
    this->Lights[half] = MakeSequence(this->Seed, half, LightSamples);
  }
  this->Requests.clear();
}

// The points of a pixel are consecutive points of the sequence of the block, those of all its pixels one net. So are
// the directions of the first round, which decides smooth surfaces; those of all later rounds of a pixel are one range.
template <int N>
void SiteSampler<N>::AddRequests(
  int cell, std::uint32_t before, std::uint32_t from, std::uint32_t to, std::uint32_t added)
{
  const Camera& camera = this->Tracer.GetCamera();
  const glm::ivec2 p = this->First + GetOffset(cell);
  if (p.x >= camera.Width || p.y >= camera.Height)
  {
    return;
  }
  const bool isShaded = before == 0 || this->Pixels[cell].IsComplex;
  const std::uint32_t wanted = before == 0 ? 1 : this->CountRaysOfHit(cell);
  const std::uint32_t rays = added % wanted != 0 ? 1 : wanted;
  const std::uint32_t first = Cells * before + cell * added;
  const std::uint32_t firstRay = before == 0 ? cell * added : (cell + 1) * MaximumSiteRays + before;
  for (std::uint32_t i = from; i < to; i += rays)
  {
    for (int half = 0; half < Halves; ++half)
    {
      this->Requests.push_back(
        { cell, half, (first + i) / rays, firstRay, rays, isShaded, added / rays });
    }
  }
}

// Camera rays choose among the layers behind the first ones, so that each needs its own ray.
template <int N>
std::uint32_t SiteSampler<N>::CountRaysOfHit(int cell) const
{
  const std::vector<LightSite<N>>& sites = this->Sites[cell];
  const bool hasLayers = std::any_of(
    sites.begin(), sites.end(), [](const LightSite<N>& site) { return site.Layer > 0; });
  return !this->Pixels[cell].IsComplex ? RaysOfHit : hasLayers ? 1 : RaysOfComplexHit;
}

// A block in which the first samples of all pixels show the background gets no further ones.
template <int N>
void SiteSampler<N>::FindSites(glm::ivec2 first)
{
  this->Begin(first);
  if constexpr (LightTerms<N>::HasRadiance)
  {
    this->Strengths = DirectionGuide::Sums();
    this->Guide = DirectionGuide();
  }
  for (int cell = 0; cell < Cells; ++cell)
  {
    this->Sites[cell].clear();
    this->Pixels[cell] = LightPixel();
    this->AddRequests(cell, 0, 0, 1, FirstSiteRays / Halves);
  }
  this->TraceRequests(true);
  const bool isEmpty =
    std::all_of(this->Sites, this->Sites + Cells, [](const auto& sites) { return sites.empty(); });
  if (isEmpty && this->Requests.size() == static_cast<std::size_t>(Halves) * Cells)
  {
    return;
  }
  this->Requests.clear();
  for (int cell = 0; cell < Cells; ++cell)
  {
    this->AddRequests(cell, 0, 1, FirstSiteRays / Halves, FirstSiteRays / Halves);
  }
  this->TraceRequests(true);
  this->Requests.clear();
  for (int cell = 0; cell < Cells; ++cell)
  {
    this->Pixels[cell].IsComplex = this->IsComplex(cell);
    for (std::uint32_t i = 0; i < this->PartSamples && this->Pixels[cell].IsComplex; ++i)
    {
      const std::uint32_t index = FirstPartIndex + (cell * this->PartSamples + i) / Halves;
      this->Requests.push_back({ cell, static_cast<int>(i % Halves), index, index, 0, true });
    }
  }
  this->TraceRequests(true);
  this->Flush();
}

template <int N>
void SiteSampler<N>::AddSamples(glm::ivec2 first, const SiteGrid<N>& grid)
{
  this->Begin(first);
  if constexpr (LightTerms<N>::HasRadiance)
  {
    this->Guide = grid.Guides[grid.GetBlock(first)];
  }
  for (int cell = 0; cell < Cells; ++cell)
  {
    const glm::ivec2 p = first + GetOffset(cell);
    LightPixel& pixel = this->Pixels[cell];
    pixel = grid.ReadPixel(p.x, p.y);
    const LightSite<N>* const sites = grid.Sites.data() + pixel.Begin;
    this->Sites[cell].assign(sites, sites + pixel.Sites);
    // The number of samples doubles, or grows by half at the end.
    while (pixel.Traced < pixel.Target)
    {
      const auto added =
        static_cast<std::uint16_t>(std::min<int>(pixel.Traced, pixel.Target - pixel.Traced));
      this->AddRequests(cell, pixel.Traced, 0, added, added);
      pixel.Traced = static_cast<std::uint16_t>(pixel.Traced + added);
    }
  }
  this->TraceRequests(false);
  this->Flush();
}

template <int N>
bool SiteSampler<N>::IsComplex(int cell) const
{
  const std::vector<LightSite<N>>& sites = this->Sites[cell];
  const LightPixel& pixel = this->Pixels[cell];
  const float samples = static_cast<float>(pixel.Samples[0]) + static_cast<float>(pixel.Samples[1]);
  return sites.size() > 1 || (sites.size() == 1 && sites[0].Samples != samples);
}

template <int N>
void SiteSampler<N>::TraceRequests(bool createsSites)
{
  const OwenSobolSequence sequences[Halves] = { MakeSequence(this->Seed, 0, PixelPositions),
    MakeSequence(this->Seed, 1, PixelPositions) };
  for (std::size_t first = 0; first < this->Requests.size(); first += PacketSize)
  {
    const int size =
      static_cast<int>(std::min<std::size_t>(this->Requests.size() - first, PacketSize));
    glm::dvec2 points[PacketSize];
    Sample samples[PacketSize];
    unsigned int shaded = 0;
    for (int i = 0; i < size; ++i)
    {
      Request& request = this->Requests[first + i];
      shaded |= (request.IsShaded ? 1u : 0u) << i;
      const glm::vec2 at = sequences[request.Half].At(request.Index);
      request.FirstRay += request.Rays * FindPlace(at, request.Index, request.Count);
      points[i] = glm::dvec2(this->First + GetOffset(request.Cell)) + glm::dvec2(at);
    }
    const unsigned int active = size == PacketSize ? 0xffffu : (1u << size) - 1u;
    this->Tracer.TraceLayers(points, active, shaded, samples, this->Layers, this->Counts);
    this->CameraRays += size;
    for (int i = 0; i < size; ++i)
    {
      const Request& request = this->Requests[first + i];
      LightPixel& pixel = this->Pixels[request.Cell];
      if (request.IsShaded)
      {
        const glm::vec3 color(samples[i].Color);
        pixel.Colors[request.Half] += color;
        pixel.Squares += color * color;
        ++pixel.Samples[request.Half];
      }
      std::vector<LitLayer>& layers = this->Layers[i];
      if (layers.size() > MaximumSiteLayers + 1)
      {
        MergeLayers<N>(layers, this->ChooseLayer(request));
      }
      for (std::size_t k = 0; k < layers.size(); ++k)
      {
        this->AddLayer(request, layers[k], static_cast<std::uint16_t>(k),
          glm::vec3(samples[i].Color), createsSites);
      }
    }
  }
}

/// Returns a number in [0, 1); those of a half are stratified.
template <int N>
float SiteSampler<N>::ChooseLayer(const Request& request) const
{
  return MakeSequence(this->Seed, request.Half, MergedLayers)
    .At(OwenSobolSequence::ShuffleIndex(request.Index, this->Seed + Halves + request.Half))
    .x;
}

// Every site gets a ray of each half.
template <int N>
void SiteSampler<N>::AddLayer(const Request& request, const LitLayer& layer, std::uint16_t number,
  glm::vec3 color, bool createsSites)
{
  const Camera& camera = this->Tracer.GetCamera();
  const double depth = layer.Where.Distance + camera.DepthOfRayOrigins();
  const auto footprint = static_cast<float>(camera.PixelSize * (camera.Parallel ? 1.0 : depth));
  std::vector<LightSite<N>>& sites = this->Sites[request.Cell];
  LightSite<N>* site = this->FindSite(
    request.Cell, layer, number, footprint, !createsSites || sites.size() == MaximumSitesOfPixel);
  const bool isNew = !site;
  if (isNew)
  {
    sites.emplace_back();
    site = &sites.back();
    site->Layer = number;
    ++this->Pixels[request.Cell].Sites;
  }
  site->Samples += 1.f;
  site->Position += (layer.Position - site->Position) / site->Samples;
  site->Normal += (layer.Normal - site->Normal) / site->Samples;
  site->Footprint = std::max(site->Footprint, footprint);
  if (request.IsShaded)
  {
    using Terms = LightTerms<N>;
    if constexpr (Terms::HasOcclusion)
    {
      site->Colors[Terms::OcclusionTerm][request.Half] += layer.Color;
      site->Products[Terms::OcclusionTerm] += layer.Color * color;
    }
    if constexpr (Terms::HasRadiance)
    {
      site->Colors[Terms::RadianceTerm][request.Half] += layer.Reflectance;
      site->Products[Terms::RadianceTerm] += layer.Reflectance * color;
    }
  }
  const auto index = static_cast<std::size_t>(site - sites.data());
  for (int half = 0; half < Halves; ++half)
  {
    const std::uint32_t rays = half == request.Half ? request.Rays : 0;
    this->QueueRays(request, index, half, isNew ? std::max(rays, 1u) : rays, layer);
  }
}

/// Returns the site that a layer belongs to; if `mustFind`, the nearest one if there is none.
template <int N>
LightSite<N>* SiteSampler<N>::FindSite(
  int cell, const LitLayer& layer, std::uint16_t number, float footprint, bool mustFind)
{
  LightSite<N>* nearest = nullptr;
  float smallest = std::numeric_limits<float>::max();
  for (LightSite<N>& site : this->Sites[cell])
  {
    const glm::vec3 normal = glm::normalize(site.Normal + layer.Normal);
    const glm::vec3 offset = layer.Position - site.Position;
    if (site.Layer == number &&
      glm::dot(site.Normal, layer.Normal) >= SameSiteCosine * glm::length(site.Normal) &&
      IsNearPlane(offset, normal, SameSiteHeight * footprint, SameSiteSlope))
    {
      return &site;
    }
    const float distance = glm::length(offset) - footprint * glm::dot(site.Normal, layer.Normal) +
      OtherLayerDistance * footprint * static_cast<float>(std::abs(site.Layer - number));
    if (mustFind && distance < smallest)
    {
      smallest = distance;
      nearest = &site;
    }
  }
  return nearest;
}

template <int N>
void SiteSampler<N>::QueueRays(
  const Request& request, std::size_t site, int half, std::uint32_t count, const LitLayer& layer)
{
  if (count == 0)
  {
    return;
  }
  const SurfaceNormals normals(layer.Normal, layer.Geometric);
  const glm::mat3 frame = FrameFromNormal(layer.Normal);
  const Ray start = this->Source.StartRay(layer.Position, normals);
  DirectionPoints points;
  FindPoints(this->Directions[half], this->Seed + half, request.FirstRay, points);
  for (std::uint32_t i = 0; i < count; ++i)
  {
    glm::vec2 at(points.X[i], points.Y[i]);
    LightPacket<N>& packet = this->Packet;
    packet.Weights[packet.Count] = LightTerms<N>::HasRadiance ? this->Guide.Move(at) : 1.f;
    packet.Rays[packet.Count] = start;
    LightRays<N>::Turn(packet.Rays[packet.Count], normals, frame, at);
    this->Owners[packet.Count] = { request.Cell, site, half, at };
    if constexpr (LightTerms<N>::HasRadiance)
    {
      const std::uint32_t index =
        OwenSobolSequence::ShuffleIndex(request.FirstRay + i, this->Seed + 2 * Halves + half);
      packet.Starts[packet.Count] = { layer.Position, normals, this->Lights[half].At(index),
        layer.Where };
    }
    ++this->TracedRays;
    if (++packet.Count == LightPacket<N>::Size)
    {
      this->Flush();
    }
  }
}

template <int N>
void SiteSampler<N>::Flush()
{
  LightPacket<N>& packet = this->Packet;
  if (packet.Count == 0)
  {
    return;
  }
  this->Source.Trace(packet, this->TracedRays);
  for (int i = 0; i < packet.Count; ++i)
  {
    const RayOwner& owner = this->Owners[i];
    LightSite<N>& site = this->Sites[owner.Cell][owner.Site];
    site.Sums[owner.Half] += packet.Values[i];
    ++site.Rays[owner.Half];
    if constexpr (LightTerms<N>::HasRadiance)
    {
      this->Strengths.Add(owner.At, packet.Strengths[i]);
    }
  }
  packet.Count = 0;
}

template class SiteSampler<1>;
template class SiteSampler<3>;
template class SiteSampler<4>;

}
