// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The triangles of a tile that may be visible in one of its pixels.
#ifndef penumbra_PixelTriangles_h
#define penumbra_PixelTriangles_h

#include "ConvexPolygon.h"
#include "TileTriangles.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace penumbra
{

/// A triangle of the pixel, relative to the origin of the pixel.
struct PixelTriangle
{
  LinearValue<float> Sides[3];
  LinearValue<float> Key; ///< minus that of the nearest triangle
  float LargestKey;
  float KeyError; ///< 0 if no surface can coincide with this one
  std::uint8_t FirstColumn, LastColumn, FirstRow, LastRow; ///< cells of SamplePoints
  bool IsFull;                                             ///< covers the pixel
  bool NeedsRays;
  bool IsLayer;
  bool IsTextured;
  std::uint32_t Index; ///< in TileTriangles
};

/// The part of a pixel that a triangle covers. Cutting the square by three sides leaves at most 7 points, and at
/// most 13 whatever rounding does.
using LayerPolygon = ConvexPolygon<float, 13>;

class PixelTriangles
{
public:
  /// `tile` must outlive this object.
  explicit PixelTriangles(TileTriangles& tile);

  /// Selects a pixel. See TileRasterizer::SelectPixel().
  bool Select(glm::ivec2 pixel);

  bool HasLayers() const { return this->IsLayered; }
  bool IsTextured() const
  {
    return this->Selected.size() == 1 && this->Selected[0].IsFull && !this->Selected[0].NeedsRays &&
      !this->Selected[0].IsLayer && this->Selected[0].IsTextured;
  }
  bool HasLines() const;
  /// Returns true if two surfaces of the pixel may coincide.
  bool HasCoincidentSurfaces() const { return this->MayCoincide; }

  const std::vector<PixelTriangle>& Get() const { return this->Selected; }
  PrimitiveId GetId(std::uint32_t triangle) const
  {
    return this->Tile.GetId(this->Selected[triangle].Index);
  }
  const CoincidentSurfaces& GetCoincidentSurfaces() const
  {
    return this->Tile.GetRays().GetCoincidentSurfaces();
  }
  LayerPolygon Clip(std::uint32_t triangle) const;

  /// Returns the depth along the view axis of a relative key.
  float ComputeDepth(float key) const
  {
    const auto sum = static_cast<float>(this->ReferenceKey + static_cast<double>(key));
    return this->IsParallel ? -sum : 1.f / sum;
  }

  /// Returns the rounding error of the distance of the nearest triangle along rays, as a difference of keys.
  float ComputeRayRounding() const;

private:
  bool Add(std::uint32_t index, glm::dvec2 corner);
  void AddAll(std::size_t bin, glm::dvec2 corner);
  void RemoveHidden(glm::dvec2 corner);
  void FindKind();

  TileTriangles& Tile;
  const bool IsParallel; ///< parallel projection
  std::vector<PixelTriangle> Selected;
  std::vector<double> Keys; ///< of Selected at the center of the pixel
  glm::ivec2 SelectedPixel{ -1 };
  double ReferenceKey = 0.0;
  bool NeedsRays = false;   ///< rays must decide what is visible, or layers
  bool IsLayered = false;   ///< layers decide
  bool MayCoincide = false; ///< two surfaces may coincide
};

}
#endif
