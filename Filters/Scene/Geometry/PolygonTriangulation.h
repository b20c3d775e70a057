// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Triangulates polygons with the same diagonals as VTK's polygon mapper, because the diagonals
// affect interpolated colors and normals.
#ifndef penumbra_PolygonTriangulation_h
#define penumbra_PolygonTriangulation_h

#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <vector>

namespace penumbra
{

/// Triangulates a polygon by ear clipping, starting at corner 1; a convex polygon becomes a fan
/// around corner 0. `triangles` receives indices into `corners`. Corners that coincide with their
/// predecessor are skipped.
VTKPENUMBRAFILTERSSCENE_EXPORT void TriangulatePolygon(
  const std::vector<glm::dvec3>& corners, std::vector<glm::uvec3>& triangles);

}
#endif
