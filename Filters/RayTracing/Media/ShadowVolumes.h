// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Where along a ray a shadow is possible at all: a few boxes hold all triangles, and behind each of
// them, seen from the light, lies a convex region.
#ifndef penumbra_ShadowVolumes_h
#define penumbra_ShadowVolumes_h

#include "Scene.h"
#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <vector>

namespace penumbra
{

/// A part of a ray, by its parameter.
struct RayInterval
{
  double From;
  double To;
};

/// A box around triangles.
struct AxisAlignedBox
{
  glm::vec3 Low;
  glm::vec3 High;
};

/// Boxes that hold all triangles of a scene that cast shadows, few enough to be asked for every ray.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT std::vector<AxisAlignedBox> BoundOccluders(const Scene& scene);

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT ShadowVolumes
{
public:
  /// What `boxes` may hide from `light`.
  ShadowVolumes(const std::vector<AxisAlignedBox>& boxes, const Light& light);

  /// Parts of origin + t direction, t in [from, to], outside which nothing stands between the ray and
  /// the light; in order, apart from each other.
  std::vector<RayInterval> Along(
    glm::dvec3 origin, glm::dvec3 direction, double from, double to) const;

private:
  /// Normal . x <= Offset.
  struct HalfSpace
  {
    glm::dvec3 Normal;
    double Offset;
  };
  using Region = std::vector<HalfSpace>; ///< what all of them hold

  static void AddSides(Region& region, int axis, glm::dvec4 light, const AxisAlignedBox& box);

  std::vector<Region> Regions;
};

}
#endif
