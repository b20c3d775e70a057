// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Finds the triangle that is visible at each sample of a pixel: compares all samples with each
// triangle that overlaps the pixel. In pixels full of edges this takes a small fraction of the time
// of rays.
#ifndef penumbra_TileRasterizer_h
#define penumbra_TileRasterizer_h

#include "NearestTriangles.h"
#include "PixelLayers.h"
#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro, which tests need

#include <cstddef>
#include <cstdint>
#include <vector>

namespace penumbra
{

/// Triangles of one tile. Each thread needs its own object.
class VTKPENUMBRAFILTERSRAYCASTING_EXPORT TileRasterizer
{
public:
  static constexpr std::uint32_t None = NearestTriangles::None;

  TileRasterizer(const RayScene& rays, const TileGrid& tiles, const TriangleBins& bins, int tile);

  /// Returns true if only rays can decide what is visible in scenes of this kind.
  static bool RequiresRays(const std::vector<Surface>& surfaces);

  /// Selects a pixel of the tile. Returns false if a ray or layers must decide what is visible: at
  /// translucent and textured surfaces, in front of the near plane, and if LayerOrder decides.
  bool SelectPixel(glm::ivec2 pixel);

  /// Finds the triangles at points of the selected pixel. `visible` receives an index for
  /// GetTriangle(), or None, for each point.
  void Rasterize(const SamplePoints& points, std::vector<std::uint32_t>& visible);

  /// Returns true if VisitLayers() decides what is visible in the selected pixel, and not a ray.
  bool HasLayers() const { return this->Pixel.HasLayers(); }

  /// Returns true if one opaque triangle with a texture that multiplies its color covers the selected
  /// pixel, and nothing is in front of it.
  bool IsTextured() const { return this->Pixel.IsTextured(); }

  /// Returns true if the selected pixel contains triangles of lines or points.
  bool HasLines() const { return this->Pixel.HasLines(); }

  /// Number of triangles of the selected pixel.
  std::size_t GetNumberOfLayers() const { return this->Pixel.Get().size(); }
  PrimitiveId GetLayer(std::uint32_t layer) const { return this->Pixel.GetId(layer); }
  /// Returns the index of a layer for GetTriangle().
  std::uint32_t GetLayerTriangle(std::uint32_t layer) const
  {
    return this->Pixel.Get()[layer].Index;
  }

  LayerPolygon ClipLayer(std::uint32_t layer) const { return this->Pixel.Clip(layer); }

  /// Returns the depth of a candidate along the view axis.
  float ComputeDepth(const LayerCandidate& candidate) const
  {
    return this->Pixel.ComputeDepth(candidate.Key);
  }

  /// See PixelLayers::VisitPoints().
  template <typename Visit>
  void VisitLayers(const SamplePoints& points, const Visit& visit)
  {
    this->Layers.VisitPoints(this->Pixel, points, visit);
  }

  PrimitiveId GetTriangle(std::uint32_t index) const { return this->Tile.GetId(index); }
  std::size_t GetNumberOfTriangles() const { return this->Tile.GetNumberOfTriangles(); }

private:
  TileTriangles Tile;
  PixelTriangles Pixel;
  NearestTriangles Nearest;
  PixelLayers Layers;
};

}
#endif
