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

/// Returns the vector from the point of a triangle with the barycentric coordinates `weights` to the curved surface, on
/// the side of the normals. It is 0 on flat surfaces, on hollow ones, and at corners. `normals`: of any length.
inline glm::vec3 LiftToSmoothSurface(const std::array<glm::vec3, 3>& points,
  const std::array<glm::vec3, 3>& normals, glm::vec3 weights)
{
  const glm::vec3 point = weights[0] * points[0] + weights[1] * points[1] + weights[2] * points[2];
  glm::vec3 lift(0.f);
  for (int i = 0; i < 3; ++i)
  {
    const glm::vec3 normal = normals[static_cast<std::size_t>(i)];
    const float height = glm::dot(point - points[static_cast<std::size_t>(i)], normal);
    if (height < 0.f)
    {
      lift -= weights[i] * height / glm::dot(normal, normal) * normal;
    }
  }
  const bool isFinite = glm::dot(lift, lift) <= std::numeric_limits<float>::max();
  return isFinite ? lift : glm::vec3(0.f);
}

/// Returns the part of this vector by which shadow rays start above the triangle. `cosine`: of the light to the normal
/// of the triangle. Larger values of TerminatorCosine move contact shadows on coarse meshes, smaller ones leave teeth.
inline float GetLiftedFraction(float cosine)
{
  constexpr float TerminatorCosine = 0.1f;
  return std::clamp(2.f - cosine / TerminatorCosine, 0.f, 1.f);
}

/// Returns a bound of the length of this vector, for all points of the triangle and both sides.
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
