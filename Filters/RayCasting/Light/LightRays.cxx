// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LightRays.h"

#include "Shading/TranslucentOcclusion.h"
#include "Vectors.h"

#include <algorithm>

namespace penumbra
{

OcclusionRays::OcclusionRays(const RayScene& rays, const DistanceFalloff& falloff, double tolerance)
  : Rays(rays),
    Falloff(falloff),
    Translucent(HasTranslucentOccluders(rays.GetSurfaces())),
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

float LightEffects::GetUniformLight() const
{
  return this->Light
    ? this->Light->GetSettings().Albedo * static_cast<float>(this->Light->GetSourceRadiance().Mean)
    : 0.f;
}

template <int N>
typename LightRays<N>::Value LightRays<N>::GetSquaredRange() const
{
  const float light = this->Effects.GetUniformLight();
  Value range(light * light);
  if constexpr (LightTerms<N>::HasOcclusion)
  {
    range[0] = 1.f;
  }
  return range;
}

template <int N>
void LightRays<N>::Trace(LightPacket<N>& packet, long long& additional) const
{
  std::for_each(
    packet.Rays + packet.Count, packet.Rays + PacketSize, [](Ray& ray) { ray.Far = -1.f; });
  std::fill(packet.Strengths, packet.Strengths + PacketSize, 0.f);
  if constexpr (LightTerms<N>::HasOcclusion)
  {
    float occlusion[PacketSize];
    if constexpr (LightTerms<N>::HasRadiance)
    {
      Ray ends[PacketSize];
      for (int i = 0; i < PacketSize; ++i)
      {
        ends[i] = packet.Rays[i];
        ends[i].Far = std::min(ends[i].Far, this->Effects.Occlusion->GetRadius());
      }
      this->Effects.Occlusion->Trace(ends, occlusion, additional);
    }
    else
    {
      this->Effects.Occlusion->Trace(packet.Rays, occlusion, additional);
    }
    for (int i = 0; i < packet.Count; ++i)
    {
      packet.Values[i][0] = packet.Weights[i] * occlusion[i];
      packet.Strengths[i] = occlusion[i];
    }
  }
  if constexpr (LightTerms<N>::HasRadiance)
  {
    this->TraceRadiance(packet, additional);
  }
}

template <int N>
void LightRays<N>::TraceRadiance(LightPacket<N>& packet, long long& additional) const
{
  const Illumination& light = *this->Effects.Light;
  const IlluminationSettings& settings = light.GetSettings();
  Hit hits[PacketSize];
  light.GetRays().Intersect16(packet.Rays, hits);
  // Beside occlusion, light guides directions as a fraction of that without occluders.
  const float uniform = this->Effects.GetUniformLight();
  const float scale = LightTerms<N>::HasOcclusion && uniform > 0.f ? 1.f / uniform : 1.f;
  glm::vec3 sampled[PacketSize];
  light.SampleLights(packet.Starts, static_cast<std::uint32_t>(packet.Count), sampled, additional);
  for (int i = 0; i < packet.Count; ++i)
  {
    const Ray& ray = packet.Rays[i];
    std::uint32_t random = MixBits(HashPoint(ray.Origin, ray.Direction));
    const glm::vec3 followed = settings.Albedo *
      light.FollowPath(
        ray, hits[i], packet.Starts[i].Normals.Shading, settings.Bounces, random, additional);
    const glm::vec3 radiance = settings.Albedo * sampled[i] + packet.Weights[i] * followed;
    packet.Strengths[i] = std::max(packet.Strengths[i], scale * MaximumComponent(followed));
    for (int c = 0; c < 3; ++c)
    {
      packet.Values[i][LightTerms<N>::FirstRadiance + c] = radiance[c];
    }
  }
}

template class LightRays<1>;
template class LightRays<3>;
template class LightRays<4>;

}
