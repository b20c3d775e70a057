// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TileRasterizer.h"

#include "Surface.h"

#include <algorithm>

namespace penumbra
{

TileRasterizer::TileRasterizer(
  const RayScene& rays, const TileGrid& tiles, const TriangleBins& bins, int tile)
  : Tile(rays, tiles, bins, tile),
    Pixel(Tile)
{
}

bool TileRasterizer::RequiresRays(const std::vector<Surface>& surfaces)
{
  return std::any_of(surfaces.begin(), surfaces.end(),
    [](const Surface& surface) { return surface.Instances != nullptr; });
}

bool TileRasterizer::SelectPixel(glm::ivec2 pixel)
{
  return this->Pixel.Select(pixel);
}

void TileRasterizer::Rasterize(const SamplePoints& points, std::vector<std::uint32_t>& visible)
{
  this->Nearest.Find(this->Pixel, points, visible);
}

}
