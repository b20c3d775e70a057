// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// All triangles at each sample of a pixel, front to back.
#ifndef penumbra_PixelLayers_h
#define penumbra_PixelLayers_h

#include "PixelTriangles.h"
#include "SamplePoints.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

/// A triangle at a point of a pixel.
struct LayerCandidate
{
  float Key;           ///< relative to that of the nearest triangle of the pixel
  std::uint32_t Layer; ///< index in PixelTriangles
};

class PixelLayers
{
public:
  /// Finds all triangles at points of a pixel down to the first opaque one, front to back, as rays meet
  /// them: of coincident ones, those that CoincidentSurfaces selects. Calls visit(point, begin, end)
  /// with the candidates of each point.
  template <typename Visit>
  void VisitPoints(const PixelTriangles& pixel, const SamplePoints& points, const Visit& visit);

private:
  void SortTriangles(const PixelTriangles& pixel);
  void CoverRows(const PixelTriangles& pixel, const SamplePoints& points, int firstRow, int rows);
  LayerCandidate* SelectLayers(
    const PixelTriangles& pixel, LayerCandidate* begin, LayerCandidate* end) const;
  LayerCandidate* SelectCoincident(
    const PixelTriangles& pixel, LayerCandidate* begin, LayerCandidate* end) const;

  /// The triangles of the pixel, about front to back, with their keys at its center.
  std::vector<LayerCandidate> Order;
  float LargestError = 0.f;               ///< KeyError of the triangles
  bool HasOpaqueTriangles = false;        ///< some hide what is behind them
  std::vector<float> Errors;              ///< KeyError of each triangle
  std::vector<float> Keys;                ///< of one triangle at some points
  std::vector<float> Sides;               ///< negative where it does not cover them
  std::vector<LayerCandidate> Candidates; ///< per point, each with space for all triangles
  std::vector<std::uint32_t> CandidateCounts;
};

template <typename Visit>
void PixelLayers::VisitPoints(
  const PixelTriangles& pixel, const SamplePoints& points, const Visit& visit)
{
  this->SortTriangles(pixel);
  const int perRow = points.GetCountPerCell() * SamplePoints::CellsPerSide;
  const int rows = points.GetCount() <= SamplePoints::MinimumCount ? SamplePoints::CellsPerSide : 1;
  for (int row = 0; row < SamplePoints::CellsPerSide; row += rows)
  {
    this->CoverRows(pixel, points, row, rows);
    for (int i = 0; i < rows * perRow; ++i)
    {
      LayerCandidate* const begin = this->Candidates.data() + i * pixel.Get().size();
      const LayerCandidate* const end =
        this->SelectLayers(pixel, begin, begin + this->CandidateCounts[i]);
      visit(static_cast<std::uint32_t>(row * perRow + i), begin, end);
    }
  }
}

}
#endif
