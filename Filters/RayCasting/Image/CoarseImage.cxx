// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CoarseImage.h"

#include "Pixels/CoverageConstants.h"
#include "Shading/HemisphereSampling.h"
#include "Shading/OwenSobolSequence.h"
#include "Vectors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace penumbra
{

namespace
{

/// Distance between the rays in pixels.
constexpr int Spacing = 8;
/// Number of rays of light from each layer, a multiple of the size of packets.
constexpr std::uint32_t RaysOfLayer = 32;
/// Part of the squared deviation of a node from its neighbors that is expected as the squared error
/// between nodes: in the same cell, and on average over the region, for objects that no ray hits.
constexpr float LocalDeviation = 0.25f;
constexpr float MeanDeviationPart = 0.25f;
/// Minimum estimated error of a coarse color, for objects that no ray of the region hits.
constexpr float CoarseErrorFloor = 0.01f;

/// Returns the light of a layer.
template <int N>
typename LightTerms<N>::Value EstimateLight(
  const LightRays<N>& source, const LitLayer& layer, RayCounts& counts)
{
  constexpr int Size = LightRays<N>::PacketSize;
  const std::uint32_t seed = HashPoint(layer.Position, layer.Normal);
  const OwenSobolSequence sequence(seed);
  const OwenSobolSequence lights(MixBits(seed));
  const SurfaceNormals normals(layer.Normal, layer.Geometric);
  const glm::mat3 frame = FrameFromNormal(layer.Normal);
  typename LightTerms<N>::Value sum(0.f);
  for (std::uint32_t first = 0; first < RaysOfLayer; first += Size)
  {
    LightPacket<N> packet;
    packet.Count = Size;
    for (std::uint32_t i = 0; i < Size; ++i)
    {
      packet.Rays[i] = source.MakeRay(layer.Position, normals, frame, sequence.At(first + i));
      packet.Starts[i] = { layer.Position, normals,
        lights.At(OwenSobolSequence::ShuffleIndex(first + i, seed)), layer.Where };
    }
    long long traced = Size;
    source.Trace(packet, traced);
    (LightTerms<N>::HasRadiance ? counts.Indirect : counts.Occlusion) += traced;
    for (const auto& value : packet.Values)
    {
      sum += value;
    }
  }
  return sum / static_cast<float>(RaysOfLayer);
}

/// The light of several layers.
struct LayerLight
{
  glm::vec3 Change{ 0.f }; ///< of the color
  float Occlusion = 0.f;   ///< mean
};

template <int N>
LayerLight EstimateLight(
  const LightEffects& effects, const std::vector<LitLayer>& layers, RayCounts& counts)
{
  using Terms = LightTerms<N>;
  const LightRays<N> source(effects);
  LayerLight result;
  for (const LitLayer& layer : layers)
  {
    const typename Terms::Value light = EstimateLight(source, layer, counts);
    result.Change +=
      Terms::ComputeChange(light, effects.GetUniformLight(), layer.Color, layer.Reflectance);
    if constexpr (Terms::HasOcclusion)
    {
      result.Occlusion += light[0] / static_cast<float>(layers.size());
    }
  }
  return result;
}

}

CoarseImage::CoarseImage(const CameraRayTracer& tracer, const LightEffects* light, glm::ivec2 low,
  glm::ivec2 high, const ProgressCallback& progress, RayCounts& counts)
  : Low(low / Spacing),
    Last(tracer.GetCamera().Width, tracer.GetCamera().Height),
    Count((high + Spacing - 1) / Spacing - this->Low + 1),
    Nodes(static_cast<std::size_t>(this->Count.x) * this->Count.y)
{
  const int nodes = static_cast<int>(this->Nodes.size());
  std::mutex totals;
  if (!ParallelForWithProgress(
        (nodes + CameraRayTracer::PacketSize - 1) / CameraRayTracer::PacketSize, 0.0, 0.0, progress,
        [&](int packet) {
          RayCounts own;
          this->TracePacket(tracer, light, packet * CameraRayTracer::PacketSize, own);
          const std::lock_guard<std::mutex> lock(totals);
          counts += own;
        }))
  {
    throw Stopped();
  }
  this->FindDeviations();
}

glm::ivec2 CoarseImage::GetPosition(glm::ivec2 node) const
{
  return glm::min((this->Low + node) * Spacing, this->Last);
}

void CoarseImage::TracePacket(
  const CameraRayTracer& tracer, const LightEffects* light, int first, RayCounts& counts)
{
  constexpr int Size = CameraRayTracer::PacketSize;
  const int count = std::min(static_cast<int>(this->Nodes.size()) - first, Size);
  const unsigned int active = (1u << count) - 1u;
  glm::dvec2 points[Size];
  Sample samples[Size];
  for (int i = 0; i < Size; ++i)
  {
    const int node = first + std::min(i, count - 1);
    points[i] = glm::dvec2(this->GetPosition({ node % this->Count.x, node / this->Count.x }));
  }
  std::vector<LitLayer> layers[Size];
  light ? tracer.TraceLayers(points, active, active, samples, layers, counts)
        : tracer.TracePacket(points, active, samples, counts);
  counts.Auxiliary += count;
  for (int i = 0; i < count; ++i)
  {
    Node& node = this->Nodes[first + i];
    node.Color = samples[i].Color;
    if (!light || layers[i].empty())
    {
      continue;
    }
    const LayerLight own = light->Select(
      [&](auto values) { return EstimateLight<values()>(*light, layers[i], counts); });
    node.Occlusion = own.Occlusion;
    for (int c = 0; c < 3; ++c)
    {
      node.Factor[c] =
        node.Color[c] > 0.f ? std::max(1.f + own.Change[c] / node.Color[c], 0.f) : 1.f;
    }
    // Indirect light of a node in a shadow is a multiple of its color, but not of that of lit pixels.
    node.LargestChange = light->HasShadows && light->Light
      ? glm::abs(own.Change)
      : glm::vec3(std::numeric_limits<float>::infinity());
  }
}

// Values that are interpolated between the neighbors of a node differ from it about twice as much as
// between nodes from the image.
void CoarseImage::FindDeviations()
{
  double sum = 0.0;
  double factorSum = 0.0;
  double changeSum = 0.0;
  for (std::size_t i = 0; i < this->Nodes.size(); ++i)
  {
    const glm::ivec2 at(static_cast<int>(i) % this->Count.x, static_cast<int>(i) / this->Count.x);
    glm::vec4 color(0.f);
    glm::vec3 factor(0.f);
    float count = 0.f;
    for (const glm::ivec2 step : { glm::ivec2(1, 0), { -1, 0 }, { 0, 1 }, { 0, -1 } })
    {
      const glm::ivec2 other = at + step;
      if (other.x >= 0 && other.y >= 0 && other.x < this->Count.x && other.y < this->Count.y)
      {
        color += this->GetNode(other).Color;
        factor += this->GetNode(other).Factor;
        count += 1.f;
      }
    }
    Node& node = this->Nodes[i];
    node.Deviation = Square<float>(MaximumComponent(glm::abs(node.Color - color / count)));
    node.FactorDeviation =
      Square<float>(MaximumComponent(glm::vec4(glm::abs(node.Factor - factor / count), 0.f)));
    sum += node.Deviation;
    factorSum += node.FactorDeviation;
    changeSum += MaximumComponent(glm::vec4(node.LargestChange, 0.f));
  }
  this->MeanLargestChange = static_cast<float>(changeSum / static_cast<double>(this->Nodes.size()));
  this->MeanDeviation = static_cast<float>(sum / static_cast<double>(this->Nodes.size()));
  this->MeanFactorDeviation =
    static_cast<float>(factorSum / static_cast<double>(this->Nodes.size()));
}

// A limited change is added, so that the error of the color is not multiplied by the factor, which may be large in
// shadows. Its own error is limited, too.
LightField::Change CoarseImage::Value::FindChange(const glm::vec4& color, float error) const
{
  const float limit = MaximumComponent(glm::vec4(this->LargestChange, 0.f));
  if (limit == std::numeric_limits<float>::infinity())
  {
    return { this->Factor, glm::vec3(0.f), this->FactorError };
  }
  LightField::Change result;
  float cut = 0.f;
  float slope = 0.f;
  for (int c = 0; c < 3; ++c)
  {
    const float change = (this->Factor[c] - 1.f) * color[c];
    result.Offset[c] = glm::clamp(change, -this->LargestChange[c], this->LargestChange[c]);
    cut = std::max(cut, std::abs(change - result.Offset[c]));
    slope = std::max(slope, std::abs(this->Factor[c] - 1.f));
  }
  result.Error = std::min(
    std::hypot(this->FactorError, cut, slope * error), std::max(limit, this->MeanLargestChange));
  return result;
}

CoarseImage::Value CoarseImage::At(int x, int y) const
{
  const glm::ivec2 cell = glm::ivec2(x, y) / Spacing - this->Low;
  const glm::vec2 low(this->GetPosition(cell));
  const glm::vec2 high(this->GetPosition(cell + 1));
  const glm::vec2 u = (glm::vec2(x, y) + 0.5f - low) / (high - low);
  Value value;
  value.Factor = glm::vec3(0.f);
  value.MeanLargestChange = this->MeanLargestChange;
  glm::vec4 least(1e30f);
  glm::vec4 most(-1e30f);
  float deviation = 0.f;
  float factorDeviation = 0.f;
  for (int i = 0; i < 4; ++i)
  {
    const Node& node = this->GetNode(cell + glm::ivec2(i & 1, i >> 1));
    const float weight = ((i & 1) ? u.x : 1.f - u.x) * ((i >> 1) ? u.y : 1.f - u.y);
    value.Color += weight * node.Color;
    value.Factor += weight * node.Factor;
    value.Occlusion += weight * node.Occlusion;
    value.LargestChange = glm::max(value.LargestChange, node.LargestChange);
    least = glm::min(least, node.Color);
    most = glm::max(most, node.Color);
    deviation += 0.25f * node.Deviation;
    factorDeviation += 0.25f * node.FactorDeviation;
  }
  value.Error = std::sqrt(Square<float>(ContrastError * MaximumComponent(most - least)) +
    LocalDeviation * deviation + MeanDeviationPart * this->MeanDeviation +
    Square<float>(CoarseErrorFloor));
  value.FactorError = MaximumComponent(glm::vec4(glm::vec3(value.Color), 0.f)) *
    std::sqrt(LocalDeviation * factorDeviation + MeanDeviationPart * this->MeanFactorDeviation);
  return value;
}

}
