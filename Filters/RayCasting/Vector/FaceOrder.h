// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Order in which convex polygons of the image are drawn so that nearer ones cover farther ones.
#ifndef penumbra_FaceOrder_h
#define penumbra_FaceOrder_h

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace penumbra
{

/// A part of a projected triangle.
struct FacePolygon
{
  std::uint32_t Face = 0;          ///< index of the triangle
  std::vector<glm::dvec2> Corners; ///< convex, counterclockwise, in pixels
  glm::dvec3 Nearness{ 0.0 };      ///< (a, b, c): a + b x + c y grows toward the camera
  std::vector<glm::dvec3> Planes;  ///< the polygon is the part of the triangle where they are >= 0

  double NearnessAt(glm::dvec2 p) const
  {
    return glm::dot(this->Nearness, glm::dvec3(1.0, p.x, p.y));
  }
};

/// Returns the signed area of a polygon, positive if it is counterclockwise.
double ComputeArea(const std::vector<glm::dvec2>& corners);

/// Returns the part of a convex polygon in which a + b x + c y >= 0.
std::vector<glm::dvec2> ClipPolygon(const std::vector<glm::dvec2>& corners, glm::dvec3 plane);

/// Splits polygons that intersect each other in space and sorts all: of two that overlap in the
/// image, the farther one is first. Returns false if there is no such order, or if the number of
/// polygons would exceed `maximum`.
bool SortFaces(std::size_t maximum, std::vector<FacePolygon>& polygons);

}
#endif
