// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Converts polygons and triangle strips to triangles.
#ifndef penumbra_SceneExtractionSurfaces_h
#define penumbra_SceneExtractionSurfaces_h

#include "SceneExtractionItem.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

struct Surface;

/// Adds the polygons and strips of `item` to `scene`, clipped by its clipping planes. Cells with
/// invalid point ids or non-finite points are skipped with a warning, triangles without area without.
void AddSurface(const DrawItem& item, Scene& scene);

/// Returns the item's points in scene coordinates, with capacity for one more.
std::vector<glm::vec3> MakePositions(const DrawItem& item, const Scene& scene);

/// Sets the colors of `surface`, whose positions are the item's points. `cells` holds the cell of
/// the item's data for each triangle; if empty, it is the triangle's index.
void SetColors(const DrawItem& item, const std::vector<std::uint32_t>& cells, Surface& surface);

/// Sets CellIds of `surface` from the CellIds of the item.
void SetCellIds(const DrawItem& item, const std::vector<std::uint32_t>& cells, Surface& surface);

}
#endif
