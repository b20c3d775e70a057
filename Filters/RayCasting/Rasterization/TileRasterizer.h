// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Finds the triangle that is visible at each sample of a pixel: compares all samples with each
// triangle that overlaps the pixel. In pixels full of edges this takes a small fraction of the time
// of rays.
#ifndef penumbra_TileRasterizer_h
#define penumbra_TileRasterizer_h

#include "Embree/RayScene.h"
#include "ProjectedTriangle.h"
#include "SamplePoints.h"
#include "TriangleBins.h"
#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro, which tests need

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace penumbra
{

/// A value that is linear in the image.
template <typename Scalar>
struct LinearValue
{
  Scalar Value; ///< at the origin
  Scalar SlopeX;
  Scalar SlopeY;
};

/// A triangle at a point of a pixel.
struct LayerCandidate
{
  float Key;           ///< relative to that of the nearest triangle of the pixel
  std::uint32_t Layer; ///< see TileRasterizer::GetLayer()
};

/// The part of a pixel that a triangle covers, in coordinates of the pixel: a convex polygon. Cutting the
/// square by three sides leaves at most 7 points, and at most 13 whatever rounding does.
struct LayerPolygon
{
  std::array<glm::vec2, 13> Points;
  int Count = 0;
};

/// Triangles of one tile. Each thread needs its own object.
class VTKPENUMBRAFILTERSRAYCASTING_EXPORT TileRasterizer
{
public:
  static constexpr std::uint32_t None = 0xffffffffu;

  TileRasterizer(const RayScene& rays, const TileGrid& tiles, const TriangleBins& bins, int tile);

  /// Returns true if only rays can decide what is visible in scenes of this kind.
  static bool RequiresRays(const Scene& scene);

  /// Selects a pixel of the tile. Returns false if a ray or layers must decide what is visible: at
  /// translucent and textured surfaces, in front of the near plane, and if LayerOrder decides.
  bool SelectPixel(glm::ivec2 pixel);

  /// Finds the triangles at points of the selected pixel. `visible` receives an index for
  /// GetTriangle(), or None, for each point.
  void Rasterize(const SamplePoints& points, std::vector<std::uint32_t>& visible);

  /// Returns true if VisitLayers() decides what is visible in the selected pixel, and not a ray.
  bool HasLayers() const { return this->IsLayered; }

  /// Returns true if one opaque triangle with a texture that multiplies its color covers the selected
  /// pixel, and nothing is in front of it.
  bool IsTextured() const
  {
    return this->Selected.size() == 1 && this->Selected[0].IsFull && !this->Selected[0].IsComplex &&
      !this->Selected[0].IsLayer && this->Selected[0].IsTextured;
  }

  /// Returns true if the selected pixel contains triangles of lines or points.
  bool HasLines() const;

  /// Number of triangles of the selected pixel.
  std::size_t GetNumberOfLayers() const { return this->Selected.size(); }
  PrimitiveId GetLayer(std::uint32_t layer) const { return this->Ids[this->Selected[layer].Index]; }
  /// Returns the index of a layer for GetTriangle().
  std::uint32_t GetLayerTriangle(std::uint32_t layer) const { return this->Selected[layer].Index; }

  LayerPolygon ClipLayer(std::uint32_t layer) const;

  /// Returns the depth of a candidate along the view axis.
  float ComputeDepth(const LayerCandidate& candidate) const
  {
    const auto key = static_cast<float>(this->ReferenceKey + static_cast<double>(candidate.Key));
    return this->IsParallel ? -key : 1.f / key;
  }

  /// Finds all triangles at points of the selected pixel down to the first opaque one, front to
  /// back, as rays meet them: of coincident ones, those that CoincidentSurfaces selects. Calls
  /// visit(point, begin, end) with the candidates of each point.
  template <typename Visit>
  void VisitLayers(const SamplePoints& points, const Visit& visit);

  PrimitiveId GetTriangle(std::uint32_t index) const { return this->Ids[index]; }
  std::size_t GetNumberOfTriangles() const { return this->Ids.size(); }

private:
  /// A triangle of the tile, relative to the origin of the tile.
  struct TileTriangle
  {
    LinearValue<double> Sides[3]; ///< positive inside
    LinearValue<double> Key;      ///< see ProjectedTriangle::Keys
    double KeyError; ///< of a coincident triangle: rounding error of Key, or of Key / Key
    glm::vec2 Low;   ///< bounds, in pixels relative to the tile
    glm::vec2 High;
    bool IsComplex;  ///< only rays can decide what is visible
    bool IsLayer;    ///< what is behind it is visible, too
    bool IsTextured; ///< by a texture that multiplies its color
    bool IsPlanar;   ///< of a surface with PlanarCells: all triangles in one plane
    double Area;     ///< of the projected triangle
  };

  /// A triangle of the selected pixel, relative to the origin of the pixel.
  struct PixelTriangle
  {
    LinearValue<float> Sides[3];
    LinearValue<float> Key; ///< minus that of the nearest triangle
    float LargestKey;
    float KeyError; ///< 0 if no surface can coincide with this one
    std::uint8_t FirstColumn, LastColumn, FirstRow, LastRow; ///< cells of SamplePoints
    bool IsFull;                                             ///< covers the pixel
    bool IsComplex;
    bool IsLayer;
    bool IsTextured;
    std::uint32_t Index; ///< in Triangles and Ids
  };

  std::vector<PrimitiveId> GetFrontFirst() const;
  void Prepare();
  ProjectedTriangle AddTriangle(PrimitiveId id);
  void BinTriangles(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& overlaps);
  void AlignPlanarTriangles();
  bool AddToPixel(std::uint32_t index, glm::dvec2 corner);
  void SortLayers();
  void CoverRows(const SamplePoints& points, int firstRow, int rows);
  LayerCandidate* SelectLayers(LayerCandidate* begin, LayerCandidate* end) const;
  LayerCandidate* SelectCoincident(LayerCandidate* begin, LayerCandidate* end) const;
  void CoverCoincident(const SamplePoints& points);

  const RayScene& Rays;
  const TriangleBins& Bins;
  const int Tile;
  const glm::dvec2 Origin; ///< lower left corner of the tile
  const int Side;
  const bool IsParallel; ///< parallel projection

  bool IsPrepared = false;
  bool IsOverfull = false;      ///< too many triangles overlap the pixels of the tile
  std::vector<PrimitiveId> Ids; ///< of the triangles of the tile
  std::vector<TileTriangle> Triangles;
  std::vector<std::uint32_t> Begin;  ///< first element of each pixel in Listed, and the end
  std::vector<std::uint32_t> Listed; ///< indices in Triangles
  std::vector<PixelTriangle> Selected;
  std::vector<double> Keys; ///< of Selected at the center of the pixel
  glm::ivec2 SelectedPixel{ -1 };
  double ReferenceKey = 0.0; ///< of the nearest triangle of the selected pixel
  bool IsComplex = false;    ///< rays must decide what is visible in the selected pixel
  bool IsLayered = false;    ///< or VisitLayers()
  bool MayCoincide = false;  ///< two surfaces of the selected pixel may coincide
  std::vector<float> Nearest;
  std::vector<float> Errors;
  std::vector<std::int32_t> Found;
  /// Indices in Selected, about front to back, with their keys at the center of the pixel.
  std::vector<LayerCandidate> LayerOrder;
  float LargestLayerError = 0.f;   ///< KeyError of Selected
  bool HasOpaqueTriangles = false; ///< Selected contains triangles that hide what is behind them
  std::vector<float> LayerErrors;  ///< KeyError of Selected
  std::vector<float> LayerKeys;    ///< of one triangle at some points
  std::vector<float> LayerSides;   ///< negative where it does not cover them
  std::vector<LayerCandidate> Candidates; ///< per point, each with space for all triangles
  std::vector<std::uint32_t> CandidateCounts;
};

template <typename Visit>
void TileRasterizer::VisitLayers(const SamplePoints& points, const Visit& visit)
{
  this->SortLayers();
  const int perRow = points.GetCountPerCell() * SamplePoints::CellsPerSide;
  const int rows = points.GetCount() <= SamplePoints::MinimumCount ? SamplePoints::CellsPerSide : 1;
  for (int row = 0; row < SamplePoints::CellsPerSide; row += rows)
  {
    this->CoverRows(points, row, rows);
    for (int i = 0; i < rows * perRow; ++i)
    {
      LayerCandidate* const begin = this->Candidates.data() + i * this->Selected.size();
      const LayerCandidate* const end = this->SelectLayers(begin, begin + this->CandidateCounts[i]);
      visit(static_cast<std::uint32_t>(row * perRow + i), begin, end);
    }
  }
}

}
#endif
