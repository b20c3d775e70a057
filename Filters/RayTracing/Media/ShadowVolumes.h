// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Conservative intervals of a ray that may be in shadow. A few boxes bound all occluders; behind
// each box, seen from the light, lies a convex shadow volume.
#ifndef penumbra_ShadowVolumes_h
#define penumbra_ShadowVolumes_h

#include "AxisAlignedBox.h"
#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <vector>

namespace penumbra
{

struct Light;
struct Surface;

/// Interval of the parameter of a ray.
struct RayInterval
{
  double From;
  double To;
};

/// Returns at most 16 boxes that bound all triangles that cast shadows.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT std::vector<AxisAlignedBox> BoundOccluders(
  const std::vector<Surface>& surfaces);

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT ShadowVolumes
{
public:
  /// Creates the shadow volumes of `boxes` for `light`.
  ShadowVolumes(const std::vector<AxisAlignedBox>& boxes, const Light& light);

  /// Returns the intervals of t in [from, to] in which origin + t direction may be in shadow,
  /// sorted and disjoint. Outside them the ray is lit.
  std::vector<RayInterval> Along(
    glm::dvec3 origin, glm::dvec3 direction, double from, double to) const;

private:
  /// Normal . x <= Offset.
  struct HalfSpace
  {
    glm::dvec3 Normal;
    double Offset;
  };
  using Region = std::vector<HalfSpace>; ///< intersection of half-spaces

  static void AddSides(Region& region, int axis, glm::dvec4 light, const AxisAlignedBox& box);

  std::vector<Region> Regions;
};

}
#endif
