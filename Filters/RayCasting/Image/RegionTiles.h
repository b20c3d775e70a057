// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Tiles of an image region: the edges, triangles and outlines in each, and the rendering of one.
#ifndef penumbra_RegionTiles_h
#define penumbra_RegionTiles_h

#include "Coverage/PixelIntegrator.h"
#include "Edges/InstanceEdges.h"
#include "Edges/RoundOutlines.h"
#include "ImageRegion.h"
#include "Tiles/TriangleBins.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace penumbra
{

/// Stores the color, with straight alpha, and the errors of a pixel.
void StorePixel(
  const PixelResult& result, float mediumError, std::size_t index, ImageRegion& region);

class RegionTiles
{
public:
  /// The pixels [Low, High) of a tile.
  struct Rectangle
  {
    glm::ivec2 Low, High;
    int GetArea() const { return (this->High.x - this->Low.x) * (this->High.y - this->Low.y); }
  };

  /// Returns the pixels whose corners the region [low, high) needs.
  static Rectangle FindPixelsOfCorners(const Scene& scene, glm::ivec2 low, glm::ivec2 high);

  /// Projects and bins the edges of the scene for the pixels of `region`. All arguments must outlive
  /// this object. Throws Stopped if `progress`, called with `fraction`, requests a stop.
  RegionTiles(const CameraRayTracer& tracer, const CornerGrid& grid, const SceneEdges& sceneEdges,
    const RenderSettings& settings, const ImageRegion& region, const ProgressCallback& progress,
    double fraction);

  int GetCount() const { return this->Count.x * this->Count.y; }
  /// Returns the number of projected edges that begin in the region and are not those of shapes in a
  /// single tile.
  long long GetNumberOfEdges() const { return this->NumberOfEdges; }

  Rectangle GetPixels(int tile) const;

  /// Counts of a rendered tile.
  struct Totals
  {
    RayCounts Rays;
    PixelCounts Pixels;
    long long Edges = 0; ///< of shapes in the tile
  };

  /// Renders the pixels of a tile that lie in the region. Returns the number of pixels that the limit of
  /// the integration left as they were, or whose refinement it ended.
  int Render(int tile, ImageRegion& region, Totals& totals) const;

private:
  glm::ivec2 GetOrigin(int tile) const;
  /// Returns the edges of a tile, in the order of their coordinates.
  std::vector<std::uint32_t> SortEdges(int tile) const;
  /// Calls use(edges) with the edges of a tile.
  template <typename Use>
  void UseEdges(int tile, const Use& use) const;
  /// Returns true if the samples of all pixels of a tile are lit.
  bool IsLit(int tile) const;
  int RenderPixels(const Rectangle& pixels, PixelIntegrator& integrator, ImageRegion& region) const;

  const CameraRayTracer& Tracer;
  const CornerGrid& Grid;
  const SceneEdges& MeshEdges;
  const RenderSettings& Settings;
  glm::ivec2 Low, High;    ///< pixels of the region
  glm::ivec2 First, Count; ///< lower left tile and number of tiles, in units of tiles
  TileGrid Cells;
  std::vector<ProjectedEdge> Edges;
  long long NumberOfEdges = 0;
  InstanceEdges Instances;
  EdgeBins EdgesByTile;
  RoundOutlines Outlines;
  std::optional<TriangleBins> Triangles;
};

}
#endif
