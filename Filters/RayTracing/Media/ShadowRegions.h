// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Where along a ray a shadow is possible at all: a few boxes hold all triangles, and behind each of
// them, seen from the light, lies a convex region.
#ifndef penumbra_ShadowRegions_h
#define penumbra_ShadowRegions_h

#include "Scene.h"
#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <vector>

namespace penumbra
{

/// A part of a ray, by its parameter.
struct Span
{
  double From;
  double To;
};

/// A box around triangles.
struct Box
{
  glm::vec3 Low;
  glm::vec3 High;
};

/// Boxes that hold all triangles of a scene that cast shadows, few enough to be asked for every ray.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT std::vector<Box> BoundTriangles(const Scene& scene);

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT ShadowRegions
{
public:
  /// What `boxes` may hide from `light`.
  ShadowRegions(const std::vector<Box>& boxes, const Light& light);

  /// Parts of origin + t direction, t in [from, to], outside which nothing stands between the ray and
  /// the light; in order, apart from each other.
  std::vector<Span> Along(glm::dvec3 origin, glm::dvec3 direction, double from, double to) const;

private:
  /// Normal . x <= Offset.
  struct HalfSpace
  {
    glm::dvec3 Normal;
    double Offset;
  };
  using Region = std::vector<HalfSpace>; ///< what all of them hold

  static void AddSides(Region& region, int axis, glm::dvec4 light, const Box& box);

  std::vector<Region> Regions;
};

}
#endif
