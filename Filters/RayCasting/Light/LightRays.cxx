// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LightRays.h"

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
void LightRays<N>::Trace(const Ray* rays, const LightReceiver* starts, int count, Value* values,
  long long& additional) const
{
  if constexpr (LightTerms<N>::HasOcclusion)
  {
    float occlusion[PacketSize];
    if constexpr (LightTerms<N>::HasRadiance)
    {
      Ray ends[PacketSize];
      for (int i = 0; i < PacketSize; ++i)
      {
        ends[i] = rays[i];
        ends[i].Far = std::min(ends[i].Far, this->Effects.Occlusion->GetRadius());
      }
      this->Effects.Occlusion->Trace(ends, occlusion, additional);
    }
    else
    {
      this->Effects.Occlusion->Trace(rays, occlusion, additional);
    }
    for (int i = 0; i < PacketSize; ++i)
    {
      values[i][0] = occlusion[i];
    }
  }
  if constexpr (LightTerms<N>::HasRadiance)
  {
    this->TraceRadiance(rays, starts, count, values, additional);
  }
}

template <int N>
void LightRays<N>::TraceRadiance(const Ray* rays, const LightReceiver* starts, int count,
  Value* values, long long& additional) const
{
  const Illumination& light = *this->Effects.Light;
  const IlluminationSettings& settings = light.GetSettings();
  Hit hits[PacketSize];
  light.GetRays().Intersect16(rays, hits);
  glm::vec3 sampled[PacketSize];
  light.SampleLights(starts, static_cast<std::uint32_t>(count), sampled, additional);
  for (int i = 0; i < count; ++i)
  {
    std::uint32_t random = MixBits(HashPoint(rays[i].Origin, rays[i].Direction));
    const glm::vec3 radiance = settings.Albedo *
      (sampled[i] +
        light.FollowPath(
          rays[i], hits[i], starts[i].Normals.Shading, settings.Bounces, random, additional));
    for (int c = 0; c < 3; ++c)
    {
      values[i][LightTerms<N>::FirstRadiance + c] = radiance[c];
    }
  }
}

template class LightRays<1>;
template class LightRays<3>;
template class LightRays<4>;

}
