// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Detection of surfaces whose triangles are smaller than pixels. Exact coverage of each of them
// would cost more than sampling.
#ifndef penumbra_SubpixelTriangles_h
#define penumbra_SubpixelTriangles_h

#include "Camera.h"
#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro

#include <glm/glm.hpp>

#include <cstddef>

namespace penumbra
{

struct Surface;

/// Finds out whether the mean visible triangle of a surface is smaller than a pixel and the surface is
/// dense. The parts of a distributed surface are added in their order.
struct SubpixelTriangles
{
  glm::dvec2 Minimum; ///< bounds in the image of the triangles that were sampled
  glm::dvec2 Maximum{ 0.0 };
  double Area = 0.0;    ///< of the triangles that were sampled, in pixels
  double Visible = 0.0; ///< number of them in the image
  std::size_t Stride;   ///< one of this number of triangles is sampled

  /// `count`: number of triangles of the whole surface.
  VTKPENUMBRAFILTERSRAYCASTING_EXPORT SubpixelTriangles(std::size_t count, const Camera& camera);
  /// Adds a part, whose first triangle has the index `first` in the whole surface.
  VTKPENUMBRAFILTERSRAYCASTING_EXPORT void Add(
    const Surface& part, std::size_t first, const Camera& camera);
  VTKPENUMBRAFILTERSRAYCASTING_EXPORT bool AreDense() const;
};

/// Returns true if the mean visible triangle is smaller than a pixel and the surface is dense.
bool HasSubpixelTriangles(const Surface& surface, const Camera& camera);

}
#endif
