// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Intersection of a ray with the plane of a triangle in double precision, with the same bits on
// every processor.
#ifndef penumbra_RayTriangle_h
#define penumbra_RayTriangle_h

#include "RayScene.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace penumbra
{

struct Surface;

/// Relative rounding error of a float: half a unit in the last place of 1.
constexpr double HalfUlp = 0.5 * std::numeric_limits<float>::epsilon();
/// Bound of the number of single-precision roundings between the origin of a ray and a hit.
constexpr double MaximumRoundings = 16.0;

struct VTKPENUMBRAFILTERSRAYTRACING_EXPORT RayTriangle
{
  bool IsValid = false;       ///< if on, the ray is not parallel to the triangle
  bool IsFront = false;       ///< if on, the ray hits the side with counterclockwise vertices
  bool IsOnEdge = false;      ///< if on, the ray passes an edge line within EdgeTolerance
  double U = 0.0;             ///< weight of the triangle's second vertex
  double V = 0.0;             ///< weight of its third vertex
  double Distance = 0.0;      ///< in units of |Ray::Direction|
  double EdgeTolerance = 0.0; ///< bound of the error of distances from edges in single precision

  RayTriangle(const Surface& surface, std::uint32_t triangle, const Ray& ray);
};

/// Returns the hit of a ray on a triangle that it is known to meet: U and V are clamped to the
/// triangle. It is no hit if the ray is parallel to the triangle.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT Hit ComputeHit(const std::vector<Surface>& surfaces,
  std::uint32_t surface, std::uint32_t triangle, const Ray& ray);

/// Returns the distance, in units of |direction|, at which a ray hits a triangle, or NaN. The test is
/// watertight: a ray through an edge hits at least one of its triangles.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT double ComputeDistance(const Surface& surface,
  std::uint32_t triangle, const glm::dvec3& origin, const glm::dvec3& direction);

}
#endif
