// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ScatteredTiles.h"

#include "LightConstants.h"
#include "Scene.h"
#include "Shading/OwenSobolSequence.h"

#include <algorithm>
#include <vector>

namespace penumbra
{
namespace
{

constexpr int PacketSize = CameraRayTracer::PacketSize;
/// Offsets of the seeds of directions, and of points of lights, from those of points in pixels.
constexpr std::uint32_t DirectionSeed = 0x68bc21ebu;
constexpr std::uint32_t LightSeed = 0x02e5be93u;

/// Returns true if the hits of two camera rays belong to one site, or show the background.
bool ShowOneSite(
  const std::vector<LitLayer>& a, const std::vector<LitLayer>& b, const Camera& camera)
{
  if (a.empty() || b.empty())
  {
    return a.empty() && b.empty();
  }
  const double depth = a[0].Where.Distance + camera.DepthOfRayOrigins();
  const auto footprint = static_cast<float>(camera.PixelSize * (camera.Parallel ? 1.0 : depth));
  return glm::dot(a[0].Normal, b[0].Normal) >= SameSiteCosine &&
    IsNearPlane(b[0].Position - a[0].Position, glm::normalize(a[0].Normal + b[0].Normal),
      SameSiteHeight * footprint, SameSiteSlope);
}

}

bool IsScattered(const CameraRayTracer& tracer, glm::ivec2 low, glm::ivec2 high, RayCounts& counts)
{
  int surfaces = 0;
  int different = 0;
  glm::dvec2 points[PacketSize] = {};
  Sample samples[PacketSize];
  std::vector<LitLayer> layers[PacketSize];
  int count = 0;
  const auto trace = [&] {
    tracer.TraceLayers(points, (1u << count) - 1u, 0, samples, layers, counts);
    counts.Auxiliary += count;
    for (int i = 0; i < count; i += 2)
    {
      surfaces += layers[i].empty() && layers[i + 1].empty() ? 0 : 1;
      different += ShowOneSite(layers[i], layers[i + 1], tracer.GetCamera()) ? 0 : 1;
    }
    count = 0;
  };
  for (int y = low.y; y < high.y; y += ProbedPixelStep)
  {
    for (int x = low.x; x < high.x; x += ProbedPixelStep)
    {
      const std::uint32_t seed =
        MixBits(static_cast<std::uint32_t>(x) + MixBits(static_cast<std::uint32_t>(y)));
      const OwenSobolSequence sequence(seed);
      const bool isRow = (seed & 1u) != 0; // an edge must not meet the pairs of one direction only
      const glm::dvec2 step(isRow ? ProbeDistance : 0.0, isRow ? 0.0 : ProbeDistance);
      points[count++] = glm::dvec2(x, y) + glm::dvec2(sequence.At(0));
      points[count++] = glm::dvec2(x, y) + glm::dvec2(sequence.At(1)) + step;
      if (count == PacketSize)
      {
        trace();
      }
    }
  }
  trace();
  return surfaces >= FewestPairs &&
    static_cast<float>(different) > ScatteredFraction * static_cast<float>(surfaces);
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
  Ray rays[PacketSize];
  LightReceiver starts[PacketSize];
  Value values[PacketSize];
  int owners[PacketSize];
  int count = 0;
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
    Ray& ray = rays[count];
    ray.Origin = layer.Position + RayOriginOffset(layer.Position) * layer.Geometric;
    ray.Direction = normals.ReflectAbove(
      FrameFromNormal(layer.Normal) * DiskToHemisphere(SampleUniformDiskConcentric(at.x, at.y)));
    ray.Far = this->Source.GetRadius();
    if constexpr (LightTerms<N>::HasRadiance)
    {
      starts[count] = { layer.Position, normals,
        lights.At(OwenSobolSequence::ShuffleIndex(sample, seed + LightSeed)) };
    }
    owners[count++] = i;
  }
  std::for_each(rays + count, rays + PacketSize, [](Ray& ray) { ray.Far = -1.f; });
  long long& traced = LightTerms<N>::HasRadiance ? counts.Indirect : counts.Occlusion;
  traced += count;
  this->Source.Trace(rays, starts, count, values, traced);
  for (int i = 0; i < count; ++i)
  {
    sums[owners[i]] += values[i];
  }
}

template class LitSamples<1>;
template class LitSamples<3>;
template class LitSamples<4>;

}
