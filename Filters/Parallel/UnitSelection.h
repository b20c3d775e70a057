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

class RankCells;
struct Surface;

/// Indices of units in ascending order.
using Units = std::vector<std::uint32_t>;

Units ListAllUnits(const Surface& surface);

/// Returns, for each of `ranks` ranks, the units that may have a part in the cells that it has marked.
std::vector<Units> SelectUnits(const Surface& surface, const RankCells& cells, std::size_t ranks);

}
#endif
