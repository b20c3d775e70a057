// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What is known of a tile of the image before its pixels are integrated: edges, triangles, and what
// follows from their number.
#ifndef penumbra_TileGeometry_h
#define penumbra_TileGeometry_h

#include "Edges/Silhouettes.h"
#include "Edges/UnsteadyNormals.h"
#include "HiddenShapes.h"
#include "Rasterization/TileRasterizer.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace penumbra
{

/// Flags per surface of a scene; empty: no surface has the property.
struct SurfaceFlags
{
  std::vector<char> Dense; ///< its triangles are smaller than pixels, and only the silhouettes and
                           ///< boundaries among their edges are found
  std::vector<char> Unsteady; ///< see HasUnsteadyNormals()
};

/// Edges of a tile: `Count` edges in `All`, or those with these indices.
struct TileEdges
{
  const std::vector<ProjectedEdge>& All;
  const std::uint32_t* Indices; ///< null: the first `Count` edges
  std::size_t Count;
  bool AreLeftOut = false;              ///< they are too many, and `Count` is 0
  const HiddenShapes* Hidden = nullptr; ///< whose edges are left out; null: none
};

/// Indices of the edges that cross a pixel.
struct EdgeList
{
  const std::uint32_t* Edges = nullptr;
  std::size_t Count = 0;
};

class TileGeometry
{
public:
  /// Sorts the edges of the tile with the lower left pixel `origin` by its side x side pixels.
  /// `rasterizer`: the triangles of the tile; null: samples are traced. All arguments must outlive
  /// this object.
  TileGeometry(const TileEdges& edges, glm::ivec2 origin, int side, TileRasterizer* rasterizer,
    const SurfaceFlags& flags);

  EdgeList GetEdges(glm::ivec2 pixel) const
  {
    const glm::ivec2 p = pixel - this->Origin;
    const std::size_t cell = static_cast<std::size_t>(p.y) * this->Side + p.x;
    return { this->Lists.Get(cell), this->Lists.GetCount(cell) };
  }

  /// Returns the depth of the nearest shape that covers a pixel and whose edges are left out because it is
  /// behind the corners.
  double GetHiddenDepth(glm::ivec2 pixel) const
  {
    return this->Hidden ? this->Hidden->GetNearestDepth(pixel)
                        : std::numeric_limits<double>::infinity();
  }

  /// Returns true if a surface is dense, see SurfaceFlags.
  bool IsDense(const Hit& hit) const
  {
    return hit.IsHit() && !this->Flags.Dense.empty() && this->Flags.Dense[hit.Surface];
  }

  /// Returns how the color changes within the triangle of a hit.
  Steadiness FindSteadiness(const CameraRayTracer& tracer, const Hit& hit) const;

  const std::vector<ProjectedEdge>& Edges;
  TileRasterizer* const Rasterizer; ///< null: samples are traced
  const bool AreEdgesLeftOut;       ///< there are too many, and the tile is sampled
  bool IsCrowded;     ///< most pixels have many edges, so that the cost of arrangements adds up
  bool RasterizesAll; ///< many pixels have edges, so that also pixels without layers are rasterized

private:
  const HiddenShapes* const Hidden;
  const glm::ivec2 Origin;
  const int Side;
  const SurfaceFlags& Flags;
  EdgeBins Lists; ///< per pixel
};

}
#endif
