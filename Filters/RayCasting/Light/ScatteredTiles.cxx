// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ScatteredTiles.h"

#include "LightConstants.h"
#include "Shading/OwenSobolSequence.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace penumbra
{
namespace
{

constexpr int PacketSize = CameraRayTracer::PacketSize;
/// Offsets of the seeds of directions, and of points of lights, from those of points in pixels.
constexpr std::uint32_t DirectionSeed = 0x68bc21ebu;
constexpr std::uint32_t LightSeed = 0x02e5be93u;

/// Returns true if the hits of two camera rays belong to one site.
bool IsSameSite(const LitLayer& a, const LitLayer& b, const CameraRayTracer& tracer)
{
  const Surface& surface = tracer.GetRays().GetSurfaces()[a.Where.Surface];
  if (surface.IsRound() && surface.Segments.empty() && a.Where.Surface == b.Where.Surface &&
    a.Where.Primitive != b.Where.Primitive)
  {
    return false; // two spheres
  }
  const Camera& camera = tracer.GetCamera();
  const double depth = a.Where.Distance + camera.DepthOfRayOrigins();
  const auto footprint = static_cast<float>(camera.PixelSize * (camera.Parallel ? 1.0 : depth));
  return glm::dot(a.Normal, b.Normal) >= SameSiteCosine &&
    IsNearPlane(b.Position - a.Position, glm::normalize(a.Normal + b.Normal),
      SameSiteHeight * footprint, SameSiteSlope);
}

/// Returns true if two camera rays show one site, or the background.
bool ShowOneSite(
  const std::vector<LitLayer>& a, const std::vector<LitLayer>& b, const CameraRayTracer& tracer)
{
  return a.empty() || b.empty() ? a.empty() && b.empty() : IsSameSite(a[0], b[0], tracer);
}

/// Pairs of camera rays, and the numbers of those that hit a surface and that hit different sites.
class ProbedPairs
{
public:
  ProbedPairs(const CameraRayTracer& tracer, RayCounts& counts)
    : Tracer(tracer),
      Counts(counts)
  {
  }

  /// Traces a pair in each pixel of [low, high) whose offset from `low` is a multiple of `step`.
  void Trace(glm::ivec2 low, glm::ivec2 high, int step)
  {
    for (int y = low.y; y < high.y; y += step)
    {
      for (int x = low.x; x < high.x; x += step)
      {
        this->AddPair(x, y);
      }
    }
    this->Flush();
  }

  /// Returns the fraction of the pairs with a surface that hit different sites.
  float GetFraction() const
  {
    return static_cast<float>(this->Different) / static_cast<float>(this->Surfaces);
  }

  /// Returns true if the number of pairs is too small to tell on which side of `fraction` theirs is.
  bool IsNear(float fraction) const
  {
    const float error = std::sqrt(fraction * (1.f - fraction) / static_cast<float>(this->Surfaces));
    return std::abs(this->GetFraction() - fraction) < CertainDeviation * error;
  }

  /// Returns true if sites are so small that few rays hit the same one.
  bool HasSmallSites() const
  {
    std::vector<const LitLayer*> sites;
    for (const LitLayer& hit : this->Hits)
    {
      if (std::none_of(sites.begin(), sites.end(),
            [&](const LitLayer* site) { return IsSameSite(*site, hit, this->Tracer); }))
      {
        sites.push_back(&hit);
      }
    }
    return this->Hits.size() < HitsOfLargeSite * sites.size();
  }

  int Surfaces = 0;

private:
  void AddPair(int x, int y)
  {
    const std::uint32_t seed =
      MixBits(static_cast<std::uint32_t>(x) + MixBits(static_cast<std::uint32_t>(y)));
    const OwenSobolSequence sequence(seed);
    const bool isRow = (seed & 1u) != 0; // an edge must not meet the pairs of one direction only
    const glm::dvec2 step(isRow ? ProbeDistance : 0.0, isRow ? 0.0 : ProbeDistance);
    this->Points[this->Count++] = glm::dvec2(x, y) + glm::dvec2(sequence.At(0));
    this->Points[this->Count++] = glm::dvec2(x, y) + glm::dvec2(sequence.At(1)) + step;
    if (this->Count == PacketSize)
    {
      this->Flush();
    }
  }

  void Flush()
  {
    if (this->Count == 0)
    {
      return;
    }
    this->Tracer.TraceLayers(
      this->Points, (1u << this->Count) - 1u, 0, this->Samples, this->Layers, this->Counts);
    this->Counts.Auxiliary += this->Count;
    for (int i = 0; i < this->Count; i += 2)
    {
      const std::vector<LitLayer>& a = this->Layers[i];
      const std::vector<LitLayer>& b = this->Layers[i + 1];
      this->Surfaces += a.empty() && b.empty() ? 0 : 1;
      this->Different += ShowOneSite(a, b, this->Tracer) ? 0 : 1;
      for (const std::vector<LitLayer>* layers : { &a, &b })
      {
        if (!layers->empty())
        {
          this->Hits.push_back(layers->front());
        }
      }
    }
    this->Count = 0;
  }

  const CameraRayTracer& Tracer;
  RayCounts& Counts;
  int Different = 0;
  std::vector<LitLayer> Hits;
  glm::dvec2 Points[PacketSize] = {};
  Sample Samples[PacketSize];
  std::vector<LitLayer> Layers[PacketSize];
  int Count = 0;
};

}

bool IsScattered(const CameraRayTracer& tracer, glm::ivec2 low, RayCounts& counts)
{
  const Camera& camera = tracer.GetCamera();
  const glm::ivec2 high = glm::min(low + LightTileSide, glm::ivec2(camera.Width, camera.Height));
  if (tracer.HasTranslucentSurfaces() || tracer.HasShafts() || tracer.GetShading().HasPenumbrae())
  {
    return false;
  }
  ProbedPairs pairs(tracer, counts);
  pairs.Trace(low, high, ProbedPixelStep);
  if (pairs.Surfaces == 0 || (pairs.Surfaces >= FewestPairs && !pairs.IsNear(ScatteredFraction)))
  {
    return pairs.Surfaces > 0 && pairs.GetFraction() > ScatteredFraction;
  }
  constexpr int Half = ProbedPixelStep / 2;
  for (const glm::ivec2 offset :
    { glm::ivec2(Half, 0), glm::ivec2(0, Half), glm::ivec2(Half, Half) })
  {
    pairs.Trace(low + offset, high, ProbedPixelStep);
  }
  return pairs.Surfaces >= FewestPairsOfAll && pairs.GetFraction() > ScatteredFraction &&
    (pairs.Surfaces >= PairsOfSparseTile || pairs.HasSmallSites());
}

template <int N>
LitSamples<N>::LitSamples(
  const CameraRayTracer& tracer, const LightRays<N>& source, float uniformLight)
  : Tracer(tracer),
    Source(source),
    UniformLight(uniformLight)
{
}

// The directions of a pixel are stratified, and so are those of each block of 2^k samples.
template <int N>
void LitSamples<N>::Trace(std::uint32_t seed, std::uint32_t first, const glm::dvec2* points,
  SampleLight::Packet& packet, RayCounts& counts) const
{
  this->Tracer.TraceLayers(points, 0xffffu, 0xffffu, packet.Samples, packet.Layers, counts);
  Value sums[PacketSize] = {};
  for (std::uint32_t i = 0; i < RaysOfLitSample; ++i)
  {
    this->AddRays(seed, RaysOfLitSample * first + i, packet, sums, counts);
  }
  for (int i = 0; i < PacketSize; ++i)
  {
    if (!packet.Layers[i].empty())
    {
      const LitLayer& layer = packet.Layers[i].front();
      const Value light = sums[i] / static_cast<float>(RaysOfLitSample);
      packet.Samples[i].Color += glm::vec4(
        LightTerms<N>::ComputeChange(light, this->UniformLight, layer.Color, layer.Reflectance),
        0.f);
      packet.Occlusion += LightTerms<N>::HasOcclusion ? light[0] : 0.f;
      ++packet.Surfaces;
    }
  }
}

template <int N>
void LitSamples<N>::AddRays(std::uint32_t seed, std::uint32_t first,
  const SampleLight::Packet& packet, Value* sums, RayCounts& counts) const
{
  const OwenSobolSequence directions(MixBits(seed + DirectionSeed));
  const OwenSobolSequence lights(MixBits(seed + LightSeed));
  LightPacket<N> traced;
  int owners[PacketSize];
  for (int i = 0; i < PacketSize; ++i)
  {
    if (packet.Layers[i].empty())
    {
      continue;
    }
    const LitLayer& layer = packet.Layers[i].front();
    const SurfaceNormals normals(layer.Normal, layer.Geometric);
    const std::uint32_t sample = first + RaysOfLitSample * static_cast<std::uint32_t>(i);
    const glm::vec2 at = directions.At(OwenSobolSequence::ShuffleIndex(sample, seed));
    traced.Rays[traced.Count] =
      this->Source.MakeRay(layer.Position, normals, FrameFromNormal(layer.Normal), at);
    if constexpr (LightTerms<N>::HasRadiance)
    {
      traced.Starts[traced.Count] = { layer.Position, normals,
        lights.At(OwenSobolSequence::ShuffleIndex(sample, seed + LightSeed)), layer.Where };
    }
    owners[traced.Count++] = i;
  }
  long long& total = LightTerms<N>::HasRadiance ? counts.Indirect : counts.Occlusion;
  total += traced.Count;
  this->Source.Trace(traced, total);
  for (int i = 0; i < traced.Count; ++i)
  {
    sums[owners[i]] += traced.Values[i];
  }
}

template class LitSamples<1>;
template class LitSamples<3>;
template class LitSamples<4>;

}
