// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Units of surfaces (see CountUnits()) that ranks need.
#ifndef penumbra_UnitSelection_h
#define penumbra_UnitSelection_h

#include <cstddef>
#include <cstdint>
#include <vector>

namespace penumbra
{

class ImageDivision;
class RankCells;
struct Camera;
struct Scene;
struct Surface;

/// Indices of units in ascending order.
using Units = std::vector<std::uint32_t>;

Units ListAllUnits(const Surface& surface);

/// Returns, for each of `ranks` ranks, the units that may have a part in the cells that it has marked.
std::vector<Units> SelectUnits(const Surface& surface, const RankCells& cells, std::size_t ranks);

/// Returns the number of units of the scene that may matter for each tile of the image.
std::vector<std::uint32_t> CountByTile(const Scene& scene);

/// Returns the units of a surface that each rank needs to render its part of the image.
std::vector<Units> SelectSeenUnits(
  const Surface& surface, const Camera& camera, const ImageDivision& division, int ranks);

}
#endif
