// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeSource.h"

namespace penumbra
{

namespace
{

/// Tiles from `First` to `Last`; none if a coordinate of `Last` is less.
struct TileRange
{
  glm::ivec2 First{ 0 };
  glm::ivec2 Last{ -1 };

  TileRange(const ShapeBounds& bounds, const TileGrid& tiles)
  {
    if (!bounds.IsVisible)
    {
      return;
    }
    this->Last = tiles.Count - 1;
    if (bounds.IsKnown)
    {
      const auto side = static_cast<double>(tiles.Side);
      const glm::dvec2 low = glm::floor((bounds.Low - 2.0 * EdgeMargin - tiles.Origin) / side);
      const glm::dvec2 high = glm::floor((bounds.High + 2.0 * EdgeMargin - tiles.Origin) / side);
      this->First = glm::ivec2(glm::clamp(low, glm::dvec2(0.0), glm::dvec2(tiles.Count)));
      this->Last = glm::ivec2(glm::clamp(high, glm::dvec2(-1.0), glm::dvec2(tiles.Count - 1)));
    }
  }

  int GetNumberOfTiles() const
  {
    const glm::ivec2 extent = glm::max(this->Last - this->First + 1, 0);
    return extent.x * extent.y;
  }
};

}

void EdgeSource::SortByTiles(
  std::size_t count, const TileGrid& tiles, int minimumLarge, const Camera& camera)
{
  const std::size_t bins = static_cast<std::size_t>(tiles.Count.x) * tiles.Count.y;
  if (count == 0 || bins == 0)
  {
    return;
  }
  const TileGrid allTiles{ glm::dvec2(0.0), tiles.Side,
    (glm::ivec2(camera.Width, camera.Height) + tiles.Side - 1) / tiles.Side };
  std::vector<char> isLarge(count, 0);
  this->ByTile.Fill(count, bins, [&](std::size_t first, std::size_t last, const auto& add) {
    for (std::size_t i = first; i < last; ++i)
    {
      const auto shape = static_cast<std::uint32_t>(i);
      const ShapeBounds bounds = this->FindBounds(shape);
      const TileRange range(bounds, tiles);
      isLarge[i] = TileRange(bounds, allTiles).GetNumberOfTiles() >= minimumLarge;
      for (int y = range.First.y; y <= range.Last.y && !isLarge[i]; ++y)
      {
        for (int x = range.First.x; x <= range.Last.x; ++x)
        {
          add(static_cast<std::size_t>(y) * tiles.Count.x + x, shape);
        }
      }
    }
  });
  for (std::size_t i = 0; i < count; ++i)
  {
    if (isLarge[i])
    {
      this->Large.push_back(static_cast<std::uint32_t>(i));
    }
  }
}

std::vector<std::uint32_t> EdgeSource::Select(int tile, const BoundsTest& isHidden) const
{
  std::vector<std::uint32_t> shapes;
  for (std::size_t i = 0; i < this->GetCount(tile); ++i)
  {
    const std::uint32_t shape = this->ByTile.Get(tile)[i];
    if (!isHidden || !isHidden(this->FindBounds(shape)))
    {
      shapes.push_back(shape);
    }
  }
  return shapes;
}

void EdgeSource::Project(const std::vector<std::uint32_t>& shapes, glm::dvec2 low, glm::dvec2 high,
  std::vector<ProjectedEdge>& edges) const
{
  for (const std::uint32_t shape : shapes)
  {
    this->ProjectShape(shape, low - 2.0 * EdgeMargin, high + 2.0 * EdgeMargin, edges);
  }
}

long long EdgeSource::ProjectLarge(const ImagePart& part, std::vector<ProjectedEdge>& edges) const
{
  long long count = 0;
  for (const std::uint32_t shape : this->Large)
  {
    const std::size_t first = edges.size();
    this->ProjectShape(shape, part.ImageLow, part.ImageHigh, edges);
    count += part.Select(first, edges);
  }
  return count;
}

}
