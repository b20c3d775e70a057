// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Polygons and triangle strips into triangles.
#ifndef penumbra_SceneExtractionSurfaces_h
#define penumbra_SceneExtractionSurfaces_h

#include "SceneExtractionItem.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

/// Adds the polygons and strips of `piece` to `scene`, cut by its clipping planes. Cells that use
/// points which do not exist or are not finite, and triangles without area, are left out with a
/// warning.
void AddSurface(const DrawItem& item, Scene& scene);

/// The positions of the piece's points in scene coordinates, with a reserve of one.
std::vector<glm::vec3> MakePositions(const DrawItem& item, const Scene& scene);

/// Fills the colours of `surface`, whose positions are the piece's points; `cells` is the cell of
/// each triangle, counted as in the piece's data; empty: the triangle's index.
void SetColors(const DrawItem& item, const std::vector<std::uint32_t>& cells, Surface& surface);

/// Fills CellIds of `surface` with what the piece calls these cells.
void SetCellIds(const DrawItem& item, const std::vector<std::uint32_t>& cells, Surface& surface);

}
#endif
