// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Where a ray meets the plane of a triangle, in double: the same bits on every processor.
#ifndef penumbra_RayTriangle_h
#define penumbra_RayTriangle_h

#include "RayScene.h"

#include <cstdint>

namespace penumbra
{

struct VTKPENUMBRAFILTERSRAYTRACING_EXPORT RayTriangle
{
  bool IsValid = false;       ///< the ray is not parallel to the triangle
  bool IsFront = false;       ///< the ray comes from where the corners turn counterclockwise
  double U = 0.0;             ///< weight of the triangle's second vertex
  double V = 0.0;             ///< weight of its third vertex
  double Distance = 0.0;      ///< in units of |Ray::Direction|
  double EdgeDistance = 0.0;  ///< from the ray to the nearest of the edges' lines; outside negative
  double EdgeTolerance = 0.0; ///< how far single precision may take the ray for elsewhere

  RayTriangle(const Surface& surface, std::uint32_t triangle, const Ray& ray);

  /// Does single precision not know on which side of an edge the ray is?
  bool IsOnEdge() const
  {
    return this->EdgeDistance<this->EdgeTolerance&& this->EdgeDistance> - this->EdgeTolerance;
  }
};

}
#endif
