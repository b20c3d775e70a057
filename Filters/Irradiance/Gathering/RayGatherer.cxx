// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RayGatherer.h"

#include "Embree/RayScene.h"
#include "IrradianceConstants.h"
#include "Shading/HemisphereSampling.h"
#include "Shading/RayTracingConstants.h"
#include "Shading/TranslucentOcclusion.h"

#include <glm/gtc/constants.hpp>

#include <utility>

namespace penumbra
{
namespace
{

constexpr std::size_t PacketSize = 16;

}

glm::vec3 NormalAt(const RayScene& rays, const Ray& ray, const Hit& hit)
{
  const glm::vec3 n = rays.GetNormal(ray, hit);
  const float length = glm::length(n);
  return length > 0.f ? n / length : glm::vec3(0.f);
}

long long RayGatherer::Gather(glm::vec3 point, const SurfaceNormals& normals,
  const std::vector<glm::vec3>& directions, std::vector<HemisphereSample>& samples) const
{
  const glm::vec3 origin = point + RayOriginOffset(point) * normals.Geometric;
  const std::size_t count = directions.size();
  const std::size_t paddedCount = (count + PacketSize - 1) / PacketSize * PacketSize;
  std::vector<Ray> rays(paddedCount, Ray{ origin, normals.Geometric, 1.f, 0.f });
  std::vector<Hit> hits(paddedCount);
  for (std::size_t i = 0; i < count; ++i)
  {
    rays[i] = Ray{ origin, normals.ReflectAbove(directions[i]), 0.f, this->GetRadius() };
  }
  for (std::size_t first = 0; first < count; first += PacketSize)
  {
    this->Rays.Intersect16(&rays[first], &hits[first]);
  }
  rays.resize(count);
  hits.resize(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    hits[i] = SkipLinesAndPoints(this->Rays, rays[i], hits[i]);
  }
  const long long additionalRays = this->ShadeHits(point, normals, rays, hits, samples);
  const DistanceFalloff falloff = this->GetFalloff();
  for (HemisphereSample& sample : samples)
  {
    sample.Radiance *= std::isinf(sample.Distance) ? 1.f : falloff.Evaluate(sample.Distance);
  }
  return static_cast<long long>(count) + additionalRays;
}

OcclusionGatherer::OcclusionGatherer(const RayScene& scene, const DistanceFalloff& falloff)
  : RayGatherer(scene),
    Falloff(falloff),
    Translucent(HasTranslucentOccluders(scene.GetSurfaces()))
{
}

long long OcclusionGatherer::ShadeHits(glm::vec3 /*point*/, const SurfaceNormals& /*normals*/,
  const std::vector<Ray>& rays, const std::vector<Hit>& hits,
  std::vector<HemisphereSample>& samples) const
{
  samples.assign(rays.size(), HemisphereSample());
  long long additionalRays = 0;
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    if (hits[i].IsHit())
    {
      samples[i].Distance = hits[i].Distance;
      samples[i].Normal = NormalAt(this->GetRays(), rays[i], hits[i]);
      samples[i].Radiance = glm::vec3(1.f);
      // Gather() multiplies the result by the falloff of the first hit.
      const float falloff = this->Translucent ? this->Falloff.Evaluate(hits[i].Distance) : 0.f;
      if (falloff > 0.f)
      {
        samples[i].Radiance = glm::vec3(TraceTranslucentOcclusion(this->GetRays(), rays[i], hits[i],
                                          this->Falloff, MinimumTransmittance, additionalRays) /
          falloff);
      }
    }
  }
  return additionalRays;
}

LightGatherer::LightGatherer(const Illumination& light, LightLookup arriving, int bounces)
  : RayGatherer(light.GetRays()),
    Light(light),
    IncidentLight(std::move(arriving)),
    Bounces(bounces)
{
}

void LightGatherer::SampleEmitters(
  glm::vec3 point, std::vector<EmitterSample>& emitterSamples) const
{
  int emitterIndex = 0;
  for (const Emitter& emitter : this->Light.GetEmitters())
  {
    ++emitterIndex;
    const glm::vec3 side = emitter.Corners[1] - emitter.Corners[0];
    const glm::vec3 other = emitter.Corners[2] - emitter.Corners[0];
    const glm::vec3 area = glm::cross(side, other) / (2.f * SamplesPerEmitter * glm::pi<float>());
    for (int i = 0; i < SamplesPerSide; ++i)
    {
      for (int j = 0; j < SamplesPerSide - i; ++j)
      {
        const float u = (static_cast<float>(i) + .333f) / SamplesPerSide;
        const float v = (static_cast<float>(j) + .333f) / SamplesPerSide;
        const glm::vec3 to = emitter.Corners[0] + u * side + v * other - point;
        const float length = glm::length(to);
        if (length > 0.f)
        {
          const glm::vec3 direction = to / length;
          const float fraction =
            emitter.Strength * std::abs(glm::dot(area, direction)) / (length * length);
          emitterSamples.push_back({ direction, length, emitter.Strength, fraction, emitterIndex });
        }
      }
    }
  }
}

long long LightGatherer::ShadeHits(glm::vec3 point, const SurfaceNormals& normals,
  const std::vector<Ray>& rays, const std::vector<Hit>& hits,
  std::vector<HemisphereSample>& samples) const
{
  samples.assign(rays.size(), HemisphereSample());
  long long additionalRays = 0;
  std::uint32_t random =
    MixBits(HashPoint(point, normals.Shading) + static_cast<std::uint32_t>(rays.size()));
  Illumination::IrradianceFunction arriving;
  if (this->IncidentLight)
  {
    arriving = [&](glm::vec3 at, const SurfaceNormals& about) {
      const std::optional<glm::vec3> cached = this->IncidentLight(at, about);
      return cached ? *cached + this->Light.SampleLights(at, about, random, additionalRays)
                    : this->Light.TracePath(at, about, this->Bounces, random, additionalRays);
    };
  }
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    if (hits[i].IsHit())
    {
      samples[i].Distance = hits[i].Distance;
      samples[i].Normal = NormalAt(this->GetRays(), rays[i], hits[i]);
    }
    samples[i].Radiance =
      this->Light.IncidentRadiance(rays[i], hits[i], normals.Shading, arriving, additionalRays);
  }
  return additionalRays;
}

}
