// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RayTriangle.h"

#include "Surface.h"

#include <algorithm>

namespace penumbra
{

namespace
{

/// Margin of the squares of distances that are compared without square roots, for roundings.
constexpr double SquareMargin = 2.0;

/// Returns the signed distance between two lines, `volume` / |`normal`|. `normal` is the cross
/// product of their directions, `volume` its scalar product with their offset. Infinite for
/// parallel lines.
double LineDistance(double volume, const glm::dvec3& normal)
{
  const double length = glm::length(normal);
  return length > 0.0 ? volume / length : std::numeric_limits<double>::infinity();
}

}

RayTriangle::RayTriangle(const Surface& surface, std::uint32_t triangle, const Ray& ray)
{
  const std::array<glm::vec3, 3> points = surface.GetPoints(triangle);
  const glm::dvec3 a(points[0]);
  const glm::dvec3 ab = glm::dvec3(points[1]) - a;
  const glm::dvec3 ac = glm::dvec3(points[2]) - a;
  const glm::dvec3 direction(ray.Direction);
  const glm::dvec3 fromA = glm::dvec3(ray.Origin) - a;
  const glm::dvec3 p = glm::cross(direction, ac);
  const glm::dvec3 q = glm::cross(fromA, ab);
  const double volume = glm::dot(ab, p);
  this->IsValid = volume != 0.0;
  if (!this->IsValid)
  {
    return;
  }
  this->IsFront = volume > 0.0;
  const double sign = this->IsFront ? 1.0 : -1.0;
  const double second = glm::dot(fromA, p);
  const double third = glm::dot(direction, q);
  this->U = second / volume;
  this->V = third / volume;
  this->Distance = glm::dot(ac, q) / volume;
  const glm::dvec3 extent = glm::abs(fromA) + glm::max(glm::abs(ab), glm::abs(ac));
  this->EdgeTolerance = MaximumRoundings * HalfUlp * std::max({ extent.x, extent.y, extent.z });
  // Most hits are far from all edges. Length of a cross product: at most the product of the lengths.
  const glm::dvec3 bc = ac - ab;
  const glm::dvec3 volumes = sign * glm::dvec3(second, third, volume - second - third);
  const glm::dvec3 squares(glm::dot(ac, ac), glm::dot(ab, ab), glm::dot(bc, bc));
  const double factor =
    SquareMargin * this->EdgeTolerance * this->EdgeTolerance * glm::dot(direction, direction);
  if (volumes.x > 0.0 && volumes.y > 0.0 && volumes.z > 0.0 &&
    volumes.x * volumes.x > factor * squares.x && volumes.y * volumes.y > factor * squares.y &&
    volumes.z * volumes.z > factor * squares.z)
  {
    return;
  }
  const double distance =
    std::min({ LineDistance(volumes.x, p), LineDistance(volumes.y, glm::cross(direction, ab)),
      LineDistance(volumes.z, glm::cross(direction, bc)) });
  this->IsOnEdge = distance < this->EdgeTolerance && distance > -this->EdgeTolerance;
}

Hit ComputeHit(const std::vector<Surface>& surfaces, std::uint32_t surface, std::uint32_t triangle,
  const Ray& ray)
{
  const RayTriangle exact(surfaces[surface], triangle, ray);
  if (!exact.IsValid)
  {
    return {};
  }
  const double u = std::clamp(exact.U, 0.0, 1.0);
  const double v = std::clamp(exact.V, 0.0, 1.0 - u);
  const auto distance = static_cast<float>(exact.Distance);
  return { surface, triangle, static_cast<float>(u), static_cast<float>(v), distance, distance };
}

double ComputeDistance(const Surface& surface, std::uint32_t triangle, const glm::dvec3& origin,
  const glm::dvec3& direction)
{
  const std::array<glm::vec3, 3> points = surface.GetPoints(triangle);
  const glm::dvec3 a = glm::dvec3(points[0]) - origin;
  const glm::dvec3 b = glm::dvec3(points[1]) - origin;
  const glm::dvec3 c = glm::dvec3(points[2]) - origin;
  // The sign changes exactly if the ends of an edge are exchanged, as in an adjacent triangle.
  const double ab = glm::dot(direction, glm::cross(a, b));
  const double bc = glm::dot(direction, glm::cross(b, c));
  const double ca = glm::dot(direction, glm::cross(c, a));
  const bool isInside =
    (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double facing = glm::dot(normal, direction);
  if (!isInside || facing == 0.0)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return glm::dot(normal, a) / facing;
}

}
