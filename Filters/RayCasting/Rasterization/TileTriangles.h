// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The projected triangles of one tile, sorted by its pixels.
#ifndef penumbra_TileTriangles_h
#define penumbra_TileTriangles_h

#include "Embree/RayScene.h"
#include "Tiles/ScreenTriangle.h"
#include "Tiles/TriangleBins.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace penumbra
{

/// Distance in pixels up to which a triangle outside a pixel is also compared with its samples.
constexpr double RasterizationMargin = 1e-3;

/// A triangle of the tile, relative to the origin of the tile.
struct TileTriangle
{
  LinearValue<double> Sides[3]; ///< positive inside
  LinearValue<double> Key;      ///< see ScreenTriangle::Keys
  double LargestKey;            ///< of its corners
  double KeyError; ///< of a coincident triangle: rounding error of Key, or of Key / Key
  glm::vec2 Low;   ///< bounds, in pixels relative to the tile
  glm::vec2 High;
  bool NeedsRays;  ///< only rays can decide what is visible
  bool IsLayer;    ///< what is behind it is visible, too
  bool IsTextured; ///< by a texture that multiplies its color
  bool IsPlanar;   ///< of a surface with PlanarCells: all triangles in one plane
  double Area;     ///< of the projected triangle
};

class TileTriangles
{
public:
  TileTriangles(const RayScene& rays, const TileGrid& tiles, const TriangleBins& bins, int tile);

  /// Projects the triangles and sorts them by pixels, unless this has been done.
  void Prepare();

  /// Returns true if too many triangles overlap the pixels of the tile, which are then not sorted.
  bool IsOverfull() const { return this->HasTooManyOverlaps; }

  const RayScene& GetRays() const { return this->Rays; }
  std::size_t GetNumberOfTriangles() const { return this->Ids.size(); }
  PrimitiveId GetId(std::uint32_t index) const { return this->Ids[index]; }
  const TileTriangle& Get(std::uint32_t index) const { return this->Triangles[index]; }

  /// Returns the position of a pixel relative to the origin of the tile.
  glm::ivec2 GetLocal(glm::ivec2 pixel) const { return pixel - glm::ivec2(this->Origin); }
  /// Returns the bin of a pixel in GetPixels().
  std::size_t GetBin(glm::ivec2 local) const
  {
    return static_cast<std::size_t>(local.y) * this->Side + local.x;
  }
  /// Indices of the triangles that overlap each pixel.
  const Bins<std::uint32_t>& GetPixels() const { return this->ByPixel; }

private:
  std::vector<PrimitiveId> GetFrontFirst() const;
  ScreenTriangle Add(PrimitiveId id);
  void AlignPlanarTriangles();

  const RayScene& Rays;
  const TriangleBins& Binned;
  const int Tile;
  const glm::dvec2 Origin; ///< lower left corner of the tile
  const int Side;
  bool IsPrepared = false;
  bool HasTooManyOverlaps = false;
  std::vector<PrimitiveId> Ids;
  std::vector<TileTriangle> Triangles;
  Bins<std::uint32_t> ByPixel;
};

}
#endif
