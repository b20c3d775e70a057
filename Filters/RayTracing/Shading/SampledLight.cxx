// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The light of suns and emitters, by rays toward them. A contribution is a weight, that of the light without shadows,
// times what its ray carries. The first rays decide whether they suffice: some go to the outline of the source, which
// edges of shadows hide or show first.
#include "HemisphereSampling.h"
#include "Illumination.h"
#include "LiftedStart.h"
#include "OwenSobolSequence.h"
#include "RayTracingConstants.h"
#include "Surface.h"
#include "Vectors.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace penumbra
{
namespace
{

constexpr float Pi = glm::pi<float>();

/// Number of rays that are traced together.
constexpr std::size_t PacketSize = 16;

/// Coordinates of the outline of a source in the unit square. Below 1, because rays to the very edge may miss, and
/// different, because the halves of a panel meet where their sum is 1.
constexpr glm::vec2 Outline(0.999f, 0.998f);

Ray MakeInactiveRay()
{
  Ray ray;
  ray.Far = -1.f;
  return ray;
}

bool IsActive(const Ray& ray)
{
  return ray.Near <= ray.Far;
}

/// Returns the corner of the unit square that is nearest to a point.
glm::vec2 FindCorner(glm::vec2 point)
{
  return 0.5f + 0.5f * Outline * glm::sign(2.f * point - 1.f);
}

}

class Illumination::SunRays
{
public:
  static constexpr std::uint32_t First = FirstSunRays;
  static constexpr std::uint32_t FirstOfPenumbra = FirstPenumbraRays;
  static constexpr std::uint32_t Maximum = MaximumSunRays;
  static constexpr double FirstErrorFraction = 1.0;
  static constexpr bool MovesFirst = true;

  explicit SunRays(const Illumination& light)
    : Light(light)
  {
  }

  /// Sets a ray of the packet. Returns its weight; 0, without a ray, if the surface does not face the sample.
  glm::vec3 Aim(std::uint32_t i, const LightReceiver& at, long long& rays)
  {
    const EnvironmentMap::Sun sun = this->Light.Settings.Map->SampleSun(at.Sample);
    const float cosine = glm::dot(at.Normals.Shading, sun.Direction);
    glm::vec3 start = at.Position;
    const bool isLifted = cosine > 0.f &&
      LiftRayStart(this->Light.SurfaceShading, start, at.Where, at.Normals, sun.Direction, rays);
    const glm::vec3 up = isLifted ? at.Normals.Shading : at.Normals.Geometric;
    const bool isAbove = cosine > 0.f && glm::dot(up, sun.Direction) > 0.f;
    this->Packet[i] = isAbove ? SpawnRay(start, up, sun.Direction) : MakeInactiveRay();
    const glm::vec3 weight = isAbove ? cosine / Pi * sun.Weight : glm::vec3(0.f);
    this->Unshadowed[i] = MaximumComponent(weight);
    return weight;
  }

  /// Traces the first `count` rays of the packet. Returns the radiance that they carry, relative to that of the sun.
  void Trace(std::uint32_t count, glm::vec3* carried, long long& rays)
  {
    if (count == 1)
    {
      this->Visible[0] = IsActive(this->Packet[0])
        ? this->Light.SurfaceShading.TraceTransmittance(this->Packet[0], rays)
        : 0.f;
    }
    else
    {
      std::fill(this->Packet.begin() + count, this->Packet.end(), MakeInactiveRay());
      this->Light.SurfaceShading.TraceTransmittance16(
        this->Packet.data(), this->Visible.data(), rays);
    }
    std::transform(this->Visible.begin(), this->Visible.begin() + count, carried,
      [](float visible) { return glm::vec3(visible); });
  }

  /// Moves some of the first rays: of a grid of 4 x 4 cells, from outer cells to the end of the row, and from corners
  /// to corners. Rows are those of the map, sampled by the first coordinate. Returns the number of rays.
  std::uint32_t AimProbes(LightReceiver at, const glm::vec2* samples, long long& rays)
  {
    for (std::uint32_t i = 0; i < First; ++i)
    {
      const glm::vec2 sample = samples[i];
      if (std::abs(2.f * sample.y - 1.f) <= 0.5f)
      {
        continue;
      }
      const glm::vec2 corner = FindCorner(sample);
      const bool isCorner = std::abs(2.f * sample.x - 1.f) > 0.5f;
      const Ray ray = this->Packet[i];
      at.Sample = { isCorner ? corner.x : sample.x, corner.y };
      this->Aim(i, at, rays);
      if (!IsActive(this->Packet[i]))
      {
        this->Packet[i] = ray;
      }
    }
    return First;
  }

  std::array<Ray, PacketSize> Packet;
  std::array<float, PacketSize>
    Unshadowed;                          ///< largest channel of the contributions without shadows
  std::array<float, PacketSize> Visible; ///< fraction of the light of each ray that arrives

private:
  const Illumination& Light;
};

class Illumination::EmitterRays
{
public:
  static constexpr std::uint32_t First = FirstEmitterRays;
  static constexpr std::uint32_t FirstOfPenumbra = 2 * FirstEmitterRays;
  static constexpr std::uint32_t Maximum = MaximumEmitterRays;
  static constexpr double FirstErrorFraction = FirstEmitterErrorFraction;
  static constexpr bool MovesFirst = false;

  explicit EmitterRays(const Illumination& light)
    : Light(light)
  {
  }

  glm::vec3 Aim(std::uint32_t i, const LightReceiver& at, long long& rays)
  {
    const SurfaceNormals& normals = at.Normals;
    EmitterTree::Sample& emitter = this->Samples[i];
    Ray& ray = this->Packet[i];
    ray = Ray();
    ray.Origin = at.Position + RayOriginOffset(at.Position) * normals.Geometric;
    emitter = this->Light.SampledEmitters->SampleDirection(ray.Origin, normals.Shading, at.Sample);
    this->Unshadowed[i] = 0.f;
    if (!(emitter.Density > 0.f))
    {
      ray = MakeInactiveRay();
      return glm::vec3(0.f);
    }
    const float density = glm::dot(normals.Shading, emitter.Direction) / Pi;
    const float weight = density * PowerHeuristic(emitter.Density, density) / emitter.Density;
    const glm::vec3 target = ray.Origin + emitter.Distance * emitter.Direction;
    glm::vec3 start = at.Position;
    glm::vec3 up = normals.Geometric;
    if (LiftRayStart(this->Light.SurfaceShading, start, at.Where, normals, emitter.Direction, rays))
    {
      // Of the same sample, only the visibility is that from the curved surface.
      up = normals.Shading;
      ray.Origin = start + RayOriginOffset(start) * up;
      const float distance = glm::distance(target, ray.Origin);
      emitter.ClearDistance *= distance / emitter.Distance;
      emitter.Distance = distance;
      emitter.Direction = (target - ray.Origin) / emitter.Distance;
    }
    if (!(glm::dot(emitter.Direction, up) > 0.f))
    {
      ray = MakeInactiveRay();
      return glm::vec3(0.f);
    }
    ray.Direction = emitter.Direction;
    ray.Far = (1.f + 2.f * EmitterDistanceTolerance) * emitter.Distance;
    this->Unshadowed[i] = weight * emitter.Target->Strength;
    return glm::vec3(weight);
  }

  // Rays are traced to the nearest hit unless all emitters are plain: coincident surfaces may hide the others.
  void Trace(std::uint32_t count, glm::vec3* carried, long long& rays)
  {
    if (this->IsPlain(count))
    {
      this->TraceOcclusion(count, carried, rays);
      return;
    }
    const RayScene& scene = this->Light.Rays;
    std::array<Hit, PacketSize> hits;
    std::fill(this->Packet.begin() + count, this->Packet.end(), MakeInactiveRay());
    if (count == 1)
    {
      hits[0] = scene.Intersect(this->Packet[0]);
    }
    else if (count <= PacketSize / 2)
    {
      scene.Intersect8(this->Packet.data(), hits.data());
    }
    else
    {
      scene.Intersect16(this->Packet.data(), hits.data());
    }
    for (std::uint32_t i = 0; i < count; ++i)
    {
      this->Visible[i] = 0.f;
      carried[i] = IsActive(this->Packet[i]) ? this->Follow(this->Packet[i], hits[i], i, rays)
                                             : glm::vec3(0.f);
    }
  }

  /// Adds rays to the corners of the unit square; toward one sphere, whose outline is at the end of the first
  /// coordinate, to a hexagon. Returns the number of rays.
  std::uint32_t AimProbes(LightReceiver at, const glm::vec2*, long long& rays)
  {
    const bool isSphere = this->Light.SampledEmitters->IsSphere();
    const std::uint32_t probes = isSphere ? 6 : 4;
    static_assert(First + 6 <= PacketSize);
    for (std::uint32_t i = 0; i < probes; ++i)
    {
      at.Sample = isSphere ? glm::vec2(Outline.x, static_cast<float>(i) / 6.f)
                           : FindCorner({ static_cast<float>(i % 2), static_cast<float>(i / 2) });
      this->Aim(First + i, at, rays);
    }
    return First + probes;
  }

  std::array<Ray, PacketSize> Packet;
  std::array<float, PacketSize>
    Unshadowed;                          ///< largest channel of the contributions without shadows
  std::array<float, PacketSize> Visible; ///< fraction of the light of each ray that arrives

private:
  /// Returns true if what is before the emitters decides whether the first `count` rays arrive.
  bool IsPlain(std::uint32_t count) const
  {
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const EmitterTree::Sample& emitter = this->Samples[i];
      if (IsActive(this->Packet[i]) &&
        !(emitter.ClearDistance > 0.f && this->Light.PlainEmitters[emitter.Target->Surface]))
      {
        return false;
      }
    }
    return true;
  }

  /// Trace() of rays toward plain emitters.
  void TraceOcclusion(std::uint32_t count, glm::vec3* carried, long long& rays)
  {
    const RayScene& scene = this->Light.Rays;
    std::array<Ray, PacketSize> shorter;
    std::array<bool, PacketSize> occluded{};
    std::fill(shorter.begin() + count, shorter.end(), MakeInactiveRay());
    for (std::uint32_t i = 0; i < count; ++i)
    {
      shorter[i] = this->Packet[i];
      if (IsActive(shorter[i]))
      {
        shorter[i].Far = this->Samples[i].ClearDistance;
        ++rays;
      }
    }
    if (count == 1)
    {
      occluded[0] = scene.Occluded(shorter[0]);
    }
    else if (count <= PacketSize / 2)
    {
      scene.Occluded8(shorter.data(), occluded.data());
    }
    else
    {
      scene.Occluded16(shorter.data(), occluded.data());
    }
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const bool isVisible = IsActive(shorter[i]) && !occluded[i];
      this->Visible[i] = isVisible ? 1.f : 0.f;
      carried[i] = glm::vec3(0.f);
      if (isVisible)
      {
        Hit hit;
        hit.Surface = this->Samples[i].Target->Surface;
        carried[i] = this->Light.SurfaceShading.ShadeEmission(shorter[i], hit).Emission;
      }
    }
  }

  /// Returns what ray `i` carries whose first hit is `hit`; follows it through translucent layers.
  glm::vec3 Follow(Ray ray, Hit hit, std::uint32_t i, long long& rays)
  {
    const EmitterTree::Sample& emitter = this->Samples[i];
    const float end = (1.f + EmitterDistanceTolerance) * emitter.Distance;
    float transmittance = 1.f;
    ++rays;
    for (int layer = 1; hit.IsHit() && hit.Distance <= end; ++layer)
    {
      if (!this->Light.Rays.GetSurfaces()[hit.Surface].IsLineOrPoint)
      {
        const bool reached = hit.Surface == emitter.Target->Surface &&
          hit.Distance >= (1.f - EmitterDistanceTolerance) * emitter.Distance;
        if (reached)
        {
          const ShadedHit shaded = this->Light.SurfaceShading.ShadeEmission(ray, hit);
          this->Visible[i] = transmittance * std::min(shaded.Color.a, 1.f);
          return this->Visible[i] * shaded.Emission;
        }
        transmittance *= 1.f - Shading::ComputeOpacity(this->Light.Rays, hit, ray);
      }
      if (layer == MaximumLayers || transmittance < MinimumTransmittance)
      {
        break;
      }
      ray = ContinueBehind(ray, hit);
      hit = this->Light.Rays.Intersect(ray);
      ++rays;
    }
    return glm::vec3(0.f);
  }

  const Illumination& Light;
  std::array<EmitterTree::Sample, PacketSize> Samples;
};

template <typename Source>
void Illumination::AddSamples(
  const LightReceiver* receivers, std::uint32_t count, glm::vec3* estimates, long long& rays) const
{
  Source source(*this);
  std::array<glm::vec3, PacketSize> weights;
  std::array<glm::vec3, PacketSize> carried;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    weights[i] = source.Aim(i, receivers[i], rays);
  }
  source.Trace(count, carried.data(), rays);
  for (std::uint32_t i = 0; i < count; ++i)
  {
    estimates[i] += weights[i] * carried[i];
  }
}

// If the first rays are as visible as each other, they suffice. Otherwise others follow, which may agree by chance.
template <typename Source>
void Illumination::AddEstimate(const LightReceiver& at, std::uint32_t seed, double tolerance,
  SampledLight& result, long long& rays) const
{
  static_assert(Source::First <= PacketSize);
  Source source(*this);
  const auto aim = [&](std::uint32_t i, glm::vec2 sample) {
    return source.Aim(i, { at.Position, at.Normals, sample, at.Where }, rays);
  };
  const OwenSobolSequence sequence(seed);
  std::array<glm::vec3, PacketSize> carried;
  std::array<glm::vec3, PacketSize> weights;
  std::array<glm::vec2, Source::First> firstSamples;
  float unshadowed = 0.f;
  for (std::uint32_t i = 0; i < Source::First; ++i)
  {
    firstSamples[i] = sequence.At(i);
    weights[i] = aim(i, firstSamples[i]);
    unshadowed += source.Unshadowed[i] / Source::First;
  }
  const std::uint32_t traced = source.AimProbes(at, firstSamples.data(), rays);
  source.Trace(traced, carried.data(), rays);
  float least = 1.f;
  float most = 0.f;
  for (std::uint32_t i = 0; i < traced; ++i)
  {
    if (IsActive(source.Packet[i]))
    {
      least = std::min(least, source.Visible[i]);
      most = std::max(most, source.Visible[i]);
    }
  }
  const double difference = std::max(most - least, 0.f) * unshadowed;
  const bool agrees = difference <= Source::FirstErrorFraction * tolerance;
  bool usesFirst = agrees && (!Source::MovesFirst || least == most);
  const StratifiedMean found = EstimateMeanOfBatches(
    [&](const glm::vec2* samples, std::uint32_t count, glm::vec3* values) {
      if (!usesFirst)
      {
        for (std::uint32_t i = 0; i < count; ++i)
        {
          weights[i] = aim(i, samples[i]);
        }
        source.Trace(count, carried.data(), rays);
      }
      usesFirst = false;
      std::transform(
        weights.begin(), weights.begin() + count, carried.begin(), values, std::multiplies<>());
    },
    seed, agrees ? Source::First : Source::FirstOfPenumbra, Source::Maximum, tolerance,
    agrees ? Source::FirstErrorFraction : 1.0, agrees ? 0.0 : difference);
  result.Mean += glm::vec3(found.Mean);
  result.Error = std::hypot(result.Error, static_cast<float>(found.Error));
}

Illumination::SampledLight Illumination::EstimateSampledLight(
  glm::vec3 point, const SurfaceNormals& normals, double tolerance, long long& rays) const
{
  SampledLight result;
  const LightReceiver at{ point, normals, glm::vec2(0.f), {} };
  const std::uint32_t seed = MixBits(HashPoint(point, normals.Shading));
  if (this->HasSuns())
  {
    this->AddEstimate<SunRays>(at, seed, tolerance, result, rays);
  }
  if (this->HasSampledEmitters())
  {
    this->AddEstimate<EmitterRays>(at, MixBits(seed), tolerance, result, rays);
  }
  return result;
}

void Illumination::SampleLights(
  const LightReceiver* receivers, std::uint32_t count, glm::vec3* estimates, long long& rays) const
{
  std::fill(estimates, estimates + count, glm::vec3(0.f));
  if (this->HasSuns())
  {
    this->AddSamples<SunRays>(receivers, count, estimates, rays);
  }
  if (this->HasSampledEmitters())
  {
    this->AddSamples<EmitterRays>(receivers, count, estimates, rays);
  }
}

glm::vec3 Illumination::SampleLights(
  glm::vec3 point, const SurfaceNormals& normals, std::uint32_t& random, long long& rays) const
{
  glm::vec3 estimate(0.f);
  if (this->HasSuns() || this->HasSampledEmitters())
  {
    const float u = NextFloat(random);
    const float v = NextFloat(random);
    const LightReceiver receiver{ point, normals, glm::vec2(u, v), {} };
    this->SampleLights(&receiver, 1, &estimate, rays);
  }
  return estimate;
}

}
