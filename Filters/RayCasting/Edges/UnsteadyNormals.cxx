// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "UnsteadyNormals.h"

#include "Camera.h"
#include "EdgeConstants.h"
#include "Execution/ParallelFor.h"
#include "Surface.h"

#include <algorithm>
#include <atomic>

namespace penumbra
{
namespace
{

/// Returns the squared distance of the origin from the segment between a and b.
double ComputeSquaredDistance(glm::dvec3 a, glm::dvec3 b)
{
  const glm::dvec3 d = b - a;
  const double square = glm::dot(d, d);
  const double t = square > 0.0 ? glm::clamp(-glm::dot(a, d) / square, 0.0, 1.0) : 0.0;
  const glm::dvec3 nearest = a + t * d;
  return glm::dot(nearest, nearest);
}

/// Returns the squared distance of the origin from the triangle abc.
double ComputeSquaredDistance(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c)
{
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double square = glm::dot(n, n);
  // The origin projects into the triangle if the planes through its sides and n have it inside.
  const bool isInside = square > 0.0 && glm::dot(glm::cross(b - a, -a), n) >= 0.0 &&
    glm::dot(glm::cross(c - b, -b), n) >= 0.0 && glm::dot(glm::cross(a - c, -c), n) >= 0.0;
  if (isInside)
  {
    const double height = glm::dot(a, n);
    return height * height / square;
  }
  return std::min(
    { ComputeSquaredDistance(a, b), ComputeSquaredDistance(b, c), ComputeSquaredDistance(c, a) });
}

}

bool HasUnsteadyNormal(const Surface& surface, std::size_t triangle)
{
  if (surface.Normals.empty() || surface.IsRound())
  {
    return false;
  }
  const glm::uvec3 corners = surface.Triangles[triangle];
  const glm::vec3 a = surface.Normals[corners.x];
  const glm::vec3 b = surface.Normals[corners.y];
  const glm::vec3 c = surface.Normals[corners.z];
  // Normals less than 90 degrees apart are steady.
  if (glm::dot(a, b) >= 0.f && glm::dot(b, c) >= 0.f && glm::dot(c, a) >= 0.f)
  {
    return false;
  }
  const double longest = std::max({ glm::dot(a, a), glm::dot(b, b), glm::dot(c, c) });
  return ComputeSquaredDistance(glm::dvec3(a), glm::dvec3(b), glm::dvec3(c)) <
    UnsteadyLength * UnsteadyLength * longest;
}

bool IsPartlyNegated(const Surface& surface, std::uint32_t primitive, const Camera& camera)
{
  if (surface.NormalRule != Surface::NormalRules::FacingCamera || surface.Normals.empty())
  {
    return false;
  }
  int away = 0;
  for (const glm::vec3 normal : surface.GetNormals(primitive, surface.Normals))
  {
    away += glm::dot(normal, glm::vec3(camera.Forward)) > 0.f;
  }
  return away % 3 != 0;
}

bool HasUnsteadyNormals(const Surface& surface)
{
  if (surface.Whole)
  {
    return surface.Whole->IsUnsteady;
  }
  if (surface.Normals.empty() || surface.IsRound())
  {
    return false;
  }
  if (surface.NormalRule == Surface::NormalRules::FacingCamera)
  {
    return true;
  }
  const std::vector<std::size_t> parts = SplitIntoParts(surface.Triangles.size(), ArrayGrain);
  std::atomic<bool> isFound(false);
  ParallelFor<std::size_t>(0, parts.size() - 1, 1, [&](std::size_t part) {
    for (std::size_t t = parts[part]; t < parts[part + 1] && !isFound; ++t)
    {
      if (HasUnsteadyNormal(surface, t))
      {
        isFound = true;
      }
    }
  });
  return isFound;
}

}
