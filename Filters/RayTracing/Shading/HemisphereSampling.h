// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Directions of a hemisphere, as dense as the cosine: the unit square mapped to the disc below
// (Shirley and Chiu's concentric map), jitter that is a function of the point alone.
#ifndef penumbra_HemisphereSampling_h
#define penumbra_HemisphereSampling_h

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace penumbra
{

/// A good 32-bit mixing function (multiplications and shifts only, the same everywhere).
inline std::uint32_t MixBits(std::uint32_t x)
{
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  x ^= x >> 16;
  return x;
}

inline std::uint32_t HashPoint(glm::vec3 point, glm::vec3 normal)
{
  const float values[6] = { point.x, point.y, point.z, normal.x, normal.y, normal.z };
  std::uint32_t seed = 0x9e3779b9u;
  for (const float value : values)
  {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    seed = MixBits(seed ^ bits);
  }
  return seed;
}

/// Uniform in [0, 1).
inline float NextFloat(std::uint32_t& state)
{
  state += 0x9e3779b9u;
  return static_cast<float>(MixBits(state) >> 8) * 0x1p-24f;
}

/// From the unit square to the unit disc, areas in proportion and neighbours kept together.
inline glm::vec2 SampleUniformDiskConcentric(float u, float v)
{
  const float a = 2.f * u - 1.f;
  const float b = 2.f * v - 1.f;
  if (a == 0.f && b == 0.f)
  {
    return glm::vec2(0.f);
  }
  const float quarter = 0.785398163f;
  const bool wide = std::abs(a) > std::abs(b);
  const float radius = wide ? a : b;
  const float angle = wide ? quarter * (b / a) : 2.f * quarter - quarter * (a / b);
  return radius * glm::vec2(std::cos(angle), std::sin(angle));
}

/// The other way round.
inline glm::vec2 InvertUniformDiskConcentric(glm::vec2 disc)
{
  if (disc == glm::vec2(0.f))
  {
    return glm::vec2(.5f);
  }
  const float quarter = 0.785398163f;
  const float length = glm::length(disc);
  glm::vec2 at;
  if (std::abs(disc.x) > std::abs(disc.y))
  {
    at.x = std::copysign(length, disc.x);
    at.y = at.x * std::atan(disc.y / disc.x) / quarter;
  }
  else
  {
    at.y = std::copysign(length, disc.y);
    at.x = at.y * std::atan(disc.x / disc.y) / quarter;
  }
  return .5f * at + .5f;
}

/// From the disc up to the hemisphere about +z.
inline glm::vec3 DiskToHemisphere(glm::vec2 disc)
{
  return glm::vec3(disc, std::sqrt(std::max(0.f, 1.f - glm::dot(disc, disc))));
}

/// Two tangents and the normal, orthonormal, as columns.
inline glm::mat3 FrameFromNormal(glm::vec3 normal)
{
  const glm::vec3 other =
    std::abs(normal.x) < .5f ? glm::vec3(1.f, 0.f, 0.f) : glm::vec3(0.f, 1.f, 0.f);
  const glm::vec3 tangent = glm::normalize(glm::cross(normal, other));
  return glm::mat3(tangent, glm::cross(normal, tangent), normal);
}

/// How far rays start above `point`, which is more than the rounding of positions, so that a
/// surface does not block itself.
inline float RayOriginOffset(glm::vec3 point)
{
  const glm::vec3 size = glm::abs(point);
  return 1e-5f * std::max(std::max(size.x, size.y), std::max(size.z, 1e-6f));
}

}
#endif
