// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Polygons into triangles the way VTK's polygon mapper cuts them, since the choice of diagonals
// shows in interpolated colours and normals.
#ifndef penumbra_PolygonTriangulation_h
#define penumbra_PolygonTriangulation_h

#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <vector>

namespace penumbra
{

/// Fills `triangles` with indices into `corners`: a fan around corner 0 where the polygon is
/// convex, else ears cut off in a walk that starts at corner 1. Corners that coincide with their
/// predecessor are skipped.
VTKPENUMBRAFILTERSSCENE_EXPORT void TriangulatePolygon(
  const std::vector<glm::dvec3>& corners, std::vector<glm::uvec3>& triangles);

}
#endif
