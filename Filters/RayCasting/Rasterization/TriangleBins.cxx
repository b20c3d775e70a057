// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleBins.h"

#include "ProjectedTriangle.h"

#include <algorithm>
#include <iterator>

namespace penumbra
{

namespace
{

// Distance in pixels up to which a triangle outside a tile is also binned into it.
constexpr double Margin = 2e-3;

bool IsComplexSurface(const Surface& surface)
{
  return surface.IsTranslucent() || surface.IsAdditive || surface.ColorTexture ||
    surface.LitTexture || surface.BaseColorTexture || surface.DetailTextures;
}

template <typename Visit>
void VisitTriangles(
  const Scene& scene, const TileGrid& tiles, const std::vector<char>& selected, const Visit& visit)
{
  for (std::uint32_t i = 0; i < scene.Surfaces.size(); ++i)
  {
    const Surface& surface = scene.Surfaces[i];
    const std::size_t count = surface.IsRound() || surface.Instances ? 0 : surface.Triangles.size();
    for (std::uint32_t j = 0; j < count; ++j)
    {
      const ProjectedTriangle triangle(surface.GetPoints(j), scene.ViewCamera);
      VisitCells(triangle, Margin, tiles.Origin, tiles.Side, tiles.Count, [&](int tile) {
        if (selected[tile])
        {
          visit(tile, PrimitiveId{ i, j });
        }
      });
    }
  }
}

}

TriangleBins::TriangleBins(
  const Scene& scene, const TileGrid& tiles, const std::vector<char>& selected)
  : Begin(selected.size() + 1, 0)
{
  if (std::find_if(selected.begin(), selected.end(), [](char c) { return c != 0; }) ==
    selected.end())
  {
    return;
  }
  std::transform(scene.Surfaces.begin(), scene.Surfaces.end(), std::back_inserter(this->Complex),
    [](const Surface& surface) { return IsComplexSurface(surface) ? 1 : 0; });
  VisitTriangles(scene, tiles, selected, [&](int tile, PrimitiveId) { ++this->Begin[tile + 1]; });
  for (std::size_t tile = 1; tile < this->Begin.size(); ++tile)
  {
    this->Begin[tile] += this->Begin[tile - 1];
  }
  this->Triangles.resize(this->Begin.back());
  std::vector<std::size_t> next(this->Begin.begin(), this->Begin.end() - 1);
  VisitTriangles(
    scene, tiles, selected, [&](int tile, PrimitiveId id) { this->Triangles[next[tile]++] = id; });
}

}
