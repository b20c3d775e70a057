// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "UnitSelection.h"

#include "Messages/SurfacePart.h"
#include "Shadows/RankCells.h"

#include <numeric>

namespace penumbra
{

Units ListAllUnits(const Surface& surface)
{
  Units units(CountUnits(surface));
  std::iota(units.begin(), units.end(), 0u);
  return units;
}

std::vector<Units> SelectUnits(const Surface& surface, const RankCells& cells, std::size_t ranks)
{
  std::vector<Units> selected(ranks);
  const auto count = static_cast<std::uint32_t>(CountUnits(surface));
  for (std::uint32_t unit = 0; unit < count; ++unit)
  {
    cells.VisitRanks(
      GetUnitBox(surface, unit), [&](std::size_t rank) { selected[rank].push_back(unit); });
  }
  return selected;
}

}
