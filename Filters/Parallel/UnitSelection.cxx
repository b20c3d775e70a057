// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "UnitSelection.h"

#include "Camera.h"
#include "ImageDivision.h"
#include "Messages/SurfacePart.h"
#include "Scene.h"
#include "Shadows/RankCells.h"
#include "Surface.h"
#include "Tiles/ScreenTriangle.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace penumbra
{

namespace
{

/// Distance in pixels from a tile up to which rays for its pixels are traced: to the corners of the next
/// pixels, and displaced by a fraction of a pixel.
constexpr double TileMargin = 2.0;

/// Calls visit(tile) for the tiles that a box may be seen in.
template <typename Visit>
void VisitTilesOfBox(const AxisAlignedBox& box, const Camera& camera, const Visit& visit)
{
  const glm::ivec2 tiles = ImageDivision::CountTiles({ camera.Width, camera.Height });
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high(-low);
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -nearest;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 p(corner & 1 ? box.Low.x : box.High.x, corner & 2 ? box.Low.y : box.High.y,
      corner & 4 ? box.Low.z : box.High.z);
    const double depth = camera.Depth(p);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
    const glm::dvec2 q = camera.Project(p);
    low = glm::min(low, q);
    high = glm::max(high, q);
  }
  if (farthest < camera.Near)
  {
    return;
  }
  glm::ivec2 first(0);
  glm::ivec2 last(tiles - 1);
  if (camera.Parallel || nearest > 0.0)
  {
    constexpr double Side = ImageDivision::TileSide;
    const glm::dvec2 end(tiles);
    first = glm::ivec2(glm::clamp(glm::floor((low - TileMargin) / Side), glm::dvec2(0.0), end));
    last =
      glm::ivec2(glm::clamp(glm::floor((high + TileMargin) / Side), glm::dvec2(-1.0), end - 1.0));
  }
  for (int y = first.y; y <= last.y; ++y)
  {
    for (int x = first.x; x <= last.x; ++x)
    {
      visit(y * tiles.x + x);
    }
  }
}

/// Calls visit(unit, tile) for all units of a surface, one after the other.
template <typename Visit>
void VisitTilesOfUnits(const Surface& surface, const Camera& camera, const Visit& visit)
{
  const glm::ivec2 tiles = ImageDivision::CountTiles({ camera.Width, camera.Height });
  const auto count = static_cast<std::uint32_t>(CountUnits(surface));
  for (std::uint32_t unit = 0; unit < count; ++unit)
  {
    const auto visitUnit = [&](int tile) { visit(unit, tile); };
    if (surface.Instances || surface.IsRound())
    {
      VisitTilesOfBox(GetUnitBox(surface, unit), camera, visitUnit);
    }
    else
    {
      VisitCells(ScreenTriangle(surface.GetPoints(unit), camera), TileMargin, glm::dvec2(0.0),
        ImageDivision::TileSide, tiles, visitUnit);
    }
  }
}

}

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

std::vector<std::uint32_t> CountByTile(const Scene& scene)
{
  const glm::ivec2 tiles =
    ImageDivision::CountTiles({ scene.ViewCamera.Width, scene.ViewCamera.Height });
  std::vector<std::uint32_t> counts(static_cast<std::size_t>(tiles.x) * tiles.y, 0);
  for (const Surface& surface : scene.Surfaces)
  {
    VisitTilesOfUnits(surface, scene.ViewCamera, [&](std::uint32_t, int tile) { ++counts[tile]; });
  }
  return counts;
}

std::vector<Units> SelectSeenUnits(
  const Surface& surface, const Camera& camera, const ImageDivision& division, int ranks)
{
  std::vector<Units> selected(static_cast<std::size_t>(ranks));
  VisitTilesOfUnits(surface, camera, [&](std::uint32_t unit, int tile) {
    Units& units = selected[static_cast<std::size_t>(division.GetOwner(tile))];
    if (units.empty() || units.back() != unit)
    {
      units.push_back(unit);
    }
  });
  return selected;
}

}
