// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Converts draw items to surfaces: one for an item without instances; many glyphs to one surface with
// instances, so that memory does not grow with the product of glyphs and triangles.
#ifndef penumbra_SceneExtractionInstances_h
#define penumbra_SceneExtractionInstances_h

#include "SceneExtractionItem.h"

#include <cstddef>
#include <vector>

namespace penumbra
{

struct Surface;

/// Returns true if the glyphs of `item` have so many triangles that instances save memory.
bool MayHaveInstances(const DrawItem& item);

/// Adds surfaces with instances of `shape`, the surface of the glyphs of `item` in coordinates of
/// its own. Returns the indices of the glyphs that must be copied as triangles: those that are cut
/// by a clipping plane, not finite or almost flat, or all if instances of this shape are not
/// supported.
std::vector<std::size_t> AddInstances(const DrawItem& item, Surface&& shape, Scene& scene);

/// Adds the surfaces, lines and points of `item` to `scene`, for each of its instances. Compatible
/// surfaces of instances are merged into one, whose CellIds are the ids of the glyphs' points.
void AddDrawItem(const DrawItem& item, double pixelsPerPoint, Scene& scene);

}
#endif
