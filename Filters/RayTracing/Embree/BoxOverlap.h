// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Overlap of the axis-aligned boxes of triangles, which makes rays slow, and copies of triangles.
#ifndef penumbra_BoxOverlap_h
#define penumbra_BoxOverlap_h

#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <vector>

namespace penumbra
{

struct Surface;

/// Areas of the boxes of the triangles of a surface.
struct VTKPENUMBRAFILTERSRAYTRACING_EXPORT BoxOverlap
{
  double Number = 0.0;   ///< area of all boxes / area of the bounds of the surface
  double Thinness = 0.0; ///< area of all boxes / twice the area of the triangles

  explicit BoxOverlap(const Surface& surface);

  /// Returns true if a ray crosses so many boxes that other methods than boxes are worth trying.
  bool IsLarge() const { return this->Number > MinimumOverlap; }

private:
  static constexpr double MinimumOverlap = 500.0;
};

/// Returns the triangles with all copies of earlier ones, of the same orientation, replaced by
/// vertices that do not exist, which Embree ignores; empty if few triangles are copies. Rays hit
/// the first of several copies, so that the image remains the same. If `isLastInFront` is true, the
/// last one remains.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT std::vector<glm::uvec3> RemoveCopies(
  const Surface& surface, bool isLastInFront = false);

}
#endif
