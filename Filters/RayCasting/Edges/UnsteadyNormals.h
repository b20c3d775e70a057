// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Detection of triangles whose interpolated normal is almost zero somewhere, or is negated in a part of
// the triangle. Its direction, and with it the color, changes abruptly there, without an edge.
#ifndef penumbra_UnsteadyNormals_h
#define penumbra_UnsteadyNormals_h

#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro, which tests need

#include <cstddef>
#include <cstdint>

namespace penumbra
{

struct Camera;
struct Surface;

/// How the color changes within a triangle, from the least to the most abrupt change.
enum class Steadiness
{
  Steady,
  PartlyNegated, ///< see IsPartlyNegated()
  Unsteady       ///< see HasUnsteadyNormal()
};

/// Returns true if the length of the interpolated normal falls below UnsteadyLength in a triangle of
/// Surface::Triangles.
VTKPENUMBRAFILTERSRAYCASTING_EXPORT bool HasUnsteadyNormal(
  const Surface& surface, std::size_t triangle);

/// Returns true if the normal of a primitive faces `camera` in one part and is negated in another.
bool IsPartlyNegated(const Surface& surface, std::uint32_t primitive, const Camera& camera);

/// Returns true if a triangle of the surface has an unsteady normal, or may be partly negated.
VTKPENUMBRAFILTERSRAYCASTING_EXPORT bool HasUnsteadyNormals(const Surface& surface);

}
#endif
