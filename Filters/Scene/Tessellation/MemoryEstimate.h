// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Memory that draw items will need as surfaces with BVH and edges.
#ifndef penumbra_MemoryEstimate_h
#define penumbra_MemoryEstimate_h

#include "SceneExtractionItem.h"
#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

#include <vector>

namespace penumbra
{

/// Throws InsufficientMemory if the surfaces of `items` with their BVH and edges certainly do not
/// fit into the available memory, see RequireMemory(). Counts cells, points and glyphs and allocates
/// nothing.
VTKPENUMBRAFILTERSSCENE_EXPORT void RequireMemoryForItems(const std::vector<DrawItem>& items);

/// The same for the polygons of a mesh, its vertices as spheres if `pointRadius` is positive, and its
/// lines as tubes if `lineRadius` is.
VTKPENUMBRAFILTERSSCENE_EXPORT void RequireMemoryForOccluders(
  vtkPolyData* mesh, double pointRadius, double lineRadius);

}
#endif
