// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Cosine-weighted sampling of the hemisphere: the concentric map of the unit square to the unit
// disk (Shirley and Chiu 1997), its lift to the hemisphere, and random numbers seeded by the point.
#ifndef penumbra_HemisphereSampling_h
#define penumbra_HemisphereSampling_h

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace penumbra
{

/// Unit normals of a point on a surface. The hemisphere of a gather is about the shading normal,
/// which is interpolated on smooth surfaces. Ray origins are offset along the geometric normal.
struct SurfaceNormals
{
  SurfaceNormals(glm::vec3 normal) // NOLINT(google-explicit-constructor): flat surfaces
    : Shading(normal),
      Geometric(normal)
  {
  }
  SurfaceNormals(glm::vec3 shading, glm::vec3 geometric)
    : Shading(shading),
      Geometric(geometric)
  {
  }
  glm::vec3 Shading;
  glm::vec3 Geometric;

  /// Returns a direction of the hemisphere about Shading that does not point into the surface:
  /// directions below the plane of the triangle are reflected by it. They would hit the triangle
  /// itself or the inside of its neighbors.
  glm::vec3 ReflectAbove(glm::vec3 direction) const
  {
    const float height = glm::dot(direction, this->Geometric);
    return height < -1e-6f ? direction - 2.f * height * this->Geometric : direction;
  }
};

/// Returns the weight of a sample of density `own` if the same direction could have been sampled
/// with density `other`.
inline float PowerHeuristic(float own, float other)
{
  const float ratio = other / own;
  return 1.f / (1.f + ratio * ratio);
}

/// Mixes the bits of a 32-bit integer; the result is the same on every platform.
inline std::uint32_t MixBits(std::uint32_t x)
{
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  x ^= x >> 16;
  return x;
}

/// Returns a random seed that depends on the bits of a point and its normal.
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

/// Returns the next random number, uniform in [0, 1).
inline float NextFloat(std::uint32_t& state)
{
  state += 0x9e3779b9u;
  return static_cast<float>(MixBits(state) >> 8) * 0x1p-24f;
}

/// Maps the unit square to the unit disk; preserves ratios of areas and is continuous.
inline glm::vec2 SampleUniformDiskConcentric(float u, float v)
{
  const float a = 2.f * u - 1.f;
  const float b = 2.f * v - 1.f;
  if (a == 0.f && b == 0.f)
  {
    return glm::vec2(0.f);
  }
  const float piOver4 = 0.785398163f;
  const bool horizontal = std::abs(a) > std::abs(b);
  const float radius = horizontal ? a : b;
  const float angle = horizontal ? piOver4 * (b / a) : 2.f * piOver4 - piOver4 * (a / b);
  return radius * glm::vec2(std::cos(angle), std::sin(angle));
}

/// Inverse of SampleUniformDiskConcentric().
inline glm::vec2 InvertUniformDiskConcentric(glm::vec2 disk)
{
  if (disk == glm::vec2(0.f))
  {
    return glm::vec2(.5f);
  }
  const float piOver4 = 0.785398163f;
  const float length = glm::length(disk);
  glm::vec2 square;
  if (std::abs(disk.x) > std::abs(disk.y))
  {
    square.x = std::copysign(length, disk.x);
    square.y = square.x * std::atan(disk.y / disk.x) / piOver4;
  }
  else
  {
    square.y = std::copysign(length, disk.y);
    square.x = square.y * std::atan(disk.x / disk.y) / piOver4;
  }
  return .5f * square + .5f;
}

/// Projects a point of the unit disk up to the hemisphere about +z.
inline glm::vec3 DiskToHemisphere(glm::vec2 disk)
{
  return glm::vec3(disk, std::sqrt(std::max(0.f, 1.f - glm::dot(disk, disk))));
}

/// Returns an orthonormal frame with two tangents and the normal as columns.
inline glm::mat3 FrameFromNormal(glm::vec3 normal)
{
  const glm::vec3 other =
    std::abs(normal.x) < .5f ? glm::vec3(1.f, 0.f, 0.f) : glm::vec3(0.f, 1.f, 0.f);
  const glm::vec3 tangent = glm::normalize(glm::cross(normal, other));
  return glm::mat3(tangent, glm::cross(normal, tangent), normal);
}

/// Returns the offset of the ray origin along the normal at `point`, which prevents the surface
/// from occluding itself: 1e-5 of the largest coordinate, about 170 times the rounding error of a
/// float.
inline float RayOriginOffset(glm::vec3 point)
{
  const glm::vec3 size = glm::abs(point);
  return 1e-5f * std::max(std::max(size.x, size.y), std::max(size.z, 1e-6f));
}

}
#endif
