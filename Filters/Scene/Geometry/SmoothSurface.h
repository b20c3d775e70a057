// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The curved surface that a triangle with normals at its corners stands for: the tangent planes there, blended.
// Hanika, Hacking the shadow terminator, Ray Tracing Gems II, chapter 4, 2021.
#ifndef penumbra_SmoothSurface_h
#define penumbra_SmoothSurface_h

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace penumbra
{

/// Returns the distance from the point of a triangle with the barycentric coordinates `weights` to the curved surface,
/// along `up`, the normal of the triangle (unit). It is 0 where the surface is flat or hollow, and at corners.
/// `normals`: of any length; those that are not on the side of `up` do not count.
inline float ComputeLift(const std::array<glm::vec3, 3>& points,
  const std::array<glm::vec3, 3>& normals, glm::vec3 weights, glm::vec3 up)
{
  const glm::vec3 point = weights[0] * points[0] + weights[1] * points[1] + weights[2] * points[2];
  float lift = 0.f;
  for (int i = 0; i < 3; ++i)
  {
    const glm::vec3 normal = normals[static_cast<std::size_t>(i)];
    const float height = glm::dot(point - points[static_cast<std::size_t>(i)], normal);
    const float cosine = glm::dot(normal, up);
    if (height < 0.f && cosine > 0.f)
    {
      lift -= weights[i] * height * cosine / glm::dot(normal, normal);
    }
  }
  return lift <= std::numeric_limits<float>::max() ? lift : 0.f;
}

/// Returns the part of this distance by which shadow rays start above the triangle. `cosine`: of the light to its
/// normal. Larger values of TerminatorCosine move contact shadows on coarse meshes, smaller ones leave teeth.
inline float GetLiftedFraction(float cosine)
{
  constexpr float TerminatorCosine = 0.1f;
  return std::clamp(2.f - cosine / TerminatorCosine, 0.f, 1.f);
}

/// Returns a bound of this distance for all points of the triangle, on both sides.
inline float LargestLift(
  const std::array<glm::vec3, 3>& points, const std::array<glm::vec3, 3>& normals)
{
  float largest = 0.f;
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (const glm::vec3& point : points)
    {
      const float height = glm::dot(point - points[i], normals[i]) / glm::length(normals[i]);
      largest = std::isfinite(height) ? std::max(largest, std::abs(height)) : largest;
    }
  }
  return largest;
}

}
#endif
