// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Intersection of a ray with a sphere or a tube in double precision, with the same bits on every
// processor.
#ifndef penumbra_RoundIntersection_h
#define penumbra_RoundIntersection_h

#include "RoundShape.h"
#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

namespace penumbra
{

/// The parameters at which a line enters and leaves a sphere or tube. Both shapes are convex.
struct VTKPENUMBRAFILTERSRAYTRACING_EXPORT RoundIntersection
{
  bool IsHit = false;
  double Enter = 0.0; ///< in units of `direction`; negative behind the origin
  double Leave = 0.0;

  RoundIntersection(const RoundShape& shape, glm::dvec3 origin, glm::dvec3 direction);

  /// Returns Enter or Leave, whichever is nearer to `distance`.
  double FindNearest(double distance) const
  {
    return distance - this->Enter <= this->Leave - distance ? this->Enter : this->Leave;
  }
};

/// The sphere that touches the surface of a shape from the inside near a point. That of a flat end
/// has the radius of the cylinder and may protrude.
struct VTKPENUMBRAFILTERSRAYTRACING_EXPORT TouchingSphere
{
  double U = 0.0; ///< position of the center between the ends of the shape, in [0, 1]
  glm::dvec3 Center{ 0.0 };
  double Radius = 0.0;

  TouchingSphere(const RoundShape& shape, glm::dvec3 point);
};

}
#endif
