// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Layers in TileRasterizer: all triangles at the samples of a pixel, in the order in which rays meet
// them.
#include "TileRasterizer.h"

#include "Embree/CoincidentSurfaces.h"
#include "Scene.h"
#include "Surface.h"
#include "Vectorized.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

namespace
{

/// Relative distance between layers up to which a ray meets only one.
constexpr double RoundingError = 0x1p-24;

/// Stores the keys of a triangle at samples, and values that are negative at those that it does not
/// cover. Both are stored everywhere, because compilers do not vectorize a branch.
PENUMBRA_VECTORIZED
void FindKeys(const float* __restrict xs, const float* __restrict ys, int count,
  const LinearValue<float>* sides, const LinearValue<float>& keys, float* __restrict found,
  float* __restrict inside)
{
  const LinearValue<float> a = sides[0];
  const LinearValue<float> b = sides[1];
  const LinearValue<float> c = sides[2];
  const LinearValue<float> k = keys;
  for (int i = 0; i < count; ++i)
  {
    const float x = xs[i];
    const float y = ys[i];
    const float p = a.Value + a.SlopeX * x + a.SlopeY * y;
    const float q = b.Value + b.SlopeX * x + b.SlopeY * y;
    const float r = c.Value + c.SlopeX * x + c.SlopeY * y;
    float least = q < p ? q : p;
    least = r < least ? r : least;
    found[i] = k.Value + k.SlopeX * x + k.SlopeY * y;
    inside[i] = least;
  }
}

}

bool TileRasterizer::HasLines() const
{
  const std::vector<Surface>& surfaces = this->Rays.GetScene().Surfaces;
  return std::any_of(
    this->Selected.begin(), this->Selected.end(), [&](const PixelTriangle& triangle) {
      return surfaces[this->Ids[triangle.Index].Surface].IsLineOrPoint;
    });
}

void TileRasterizer::SortLayers()
{
  this->LayerOrder.clear();
  this->LayerErrors.clear();
  this->LargestLayerError = 0.f;
  this->HasOpaqueTriangles = false;
  for (const PixelTriangle& triangle : this->Selected)
  {
    const LinearValue<float>& key = triangle.Key;
    this->LayerOrder.push_back({ key.Value + 0.5f * (key.SlopeX + key.SlopeY),
      static_cast<std::uint32_t>(this->LayerOrder.size()) });
    this->LayerErrors.push_back(triangle.KeyError);
    this->LargestLayerError = std::max(this->LargestLayerError, triangle.KeyError);
    this->HasOpaqueTriangles = this->HasOpaqueTriangles || !triangle.IsLayer;
  }
  std::sort(this->LayerOrder.begin(), this->LayerOrder.end(),
    [](const LayerCandidate& a, const LayerCandidate& b) {
      return a.Key != b.Key ? a.Key > b.Key : a.Layer < b.Layer;
    });
}

// Finds the candidates at the points of some rows of cells.
void TileRasterizer::CoverRows(const SamplePoints& points, int firstRow, int rows)
{
  const int perCell = points.GetCountPerCell();
  const int perRow = perCell * SamplePoints::CellsPerSide;
  const int lastRow = firstRow + rows - 1;
  const std::size_t stride = this->Selected.size();
  const std::size_t count = static_cast<std::size_t>(rows) * perRow;
  this->LayerKeys.resize(count);
  this->LayerSides.resize(count);
  // One more, because a candidate is written before it is known to be one.
  this->Candidates.resize(std::max(this->Candidates.size(), count * stride + 1));
  this->CandidateCounts.assign(count, 0);
  for (const LayerCandidate& layer : this->LayerOrder)
  {
    const std::uint32_t index = layer.Layer;
    const PixelTriangle& triangle = this->Selected[index];
    const int low = std::max<int>(triangle.FirstRow, firstRow);
    const int high = std::min<int>(triangle.LastRow, lastRow);
    if (low > high)
    {
      continue;
    }
    // Several rows include points beyond the columns of the triangle.
    const int begin = (low - firstRow) * perRow + (rows == 1 ? triangle.FirstColumn * perCell : 0);
    const int end =
      (high - firstRow) * perRow + (rows == 1 ? (triangle.LastColumn + 1) * perCell : perRow);
    const int first = firstRow * perRow + begin;
    FindKeys(points.X.data() + first, points.Y.data() + first, end - begin, triangle.Sides,
      triangle.Key, this->LayerKeys.data(), this->LayerSides.data());
    for (int i = begin; i < end; ++i)
    {
      std::uint32_t& number = this->CandidateCounts[i];
      this->Candidates[i * stride + number] = { this->LayerKeys[i - begin], index };
      number += this->LayerSides[i - begin] >= 0.f ? 1 : 0;
    }
  }
}

// Sorts the candidates of a point. Returns the end of those that are layers.
LayerCandidate* TileRasterizer::SelectLayers(LayerCandidate* begin, LayerCandidate* end) const
{
  // A ray continues behind a hit, whose distance is rounded.
  const auto rounding = static_cast<float>(RoundingError * std::abs(this->ReferenceKey));
  for (LayerCandidate* next = begin; next < end; ++next)
  {
    const LayerCandidate candidate = *next;
    LayerCandidate* at = next;
    for (; at > begin && at[-1].Key < candidate.Key; --at)
    {
      *at = at[-1];
    }
    *at = candidate;
  }
  float gap = std::numeric_limits<float>::infinity();
  for (const LayerCandidate* next = begin; next + 1 < end; ++next)
  {
    gap = std::min(gap, next[0].Key - next[1].Key);
  }
  if (gap <= std::max(2.f * this->LargestLayerError, rounding))
  {
    end = this->SelectCoincident(begin, end);
  }
  if (!this->HasOpaqueTriangles)
  {
    return end;
  }
  for (LayerCandidate* next = begin; next < end; ++next)
  {
    if (!this->Selected[next->Layer].IsLayer)
    {
      return next + 1;
    }
  }
  return end;
}

// Of triangles that single precision cannot separate from the nearest one, keeps those that a ray
// meets, in the order of CoincidentSurfaces.
LayerCandidate* TileRasterizer::SelectCoincident(LayerCandidate* begin, LayerCandidate* end) const
{
  const CoincidentSurfaces& surfaces = this->Rays.GetCoincidentSurfaces();
  const auto rounding = static_cast<float>(RoundingError * std::abs(this->ReferenceKey));
  LayerCandidate* kept = begin;
  for (LayerCandidate *first = begin, *last = begin; first < end; first = last)
  {
    const float error = this->LayerErrors[first->Layer];
    for (last = first + 1; last < end; ++last)
    {
      const float other = this->LayerErrors[last->Layer];
      const float both = error > 0.f && other > 0.f ? error + other : 0.f;
      if (first->Key - last->Key > std::max(both, rounding))
      {
        break;
      }
    }
    if (last - first > 1)
    {
      std::sort(first, last, [&](const LayerCandidate& a, const LayerCandidate& b) {
        const PrimitiveId p = this->GetLayer(a.Layer);
        const PrimitiveId q = this->GetLayer(b.Layer);
        return surfaces.IsInFront(p.Surface, p.Primitive, q.Surface, q.Primitive);
      });
    }
    int next = 0;
    for (const LayerCandidate* candidate = first; candidate < last; ++candidate)
    {
      const std::uint32_t surface = this->GetLayer(candidate->Layer).Surface;
      if (last - first == 1 || surfaces.GetDrawOrder(surface) >= next)
      {
        next = surfaces.DepthTolerance(surface) > 0.f ? surfaces.GetNextInOrder(surface)
                                                      : std::numeric_limits<int>::max();
        *kept++ = *candidate;
      }
    }
  }
  return kept;
}

LayerPolygon TileRasterizer::ClipLayer(std::uint32_t layer) const
{
  const PixelTriangle& triangle = this->Selected[layer];
  LayerPolygon polygon{ { { { 0.f, 0.f }, { 1.f, 0.f }, { 1.f, 1.f }, { 0.f, 1.f } } }, 4 };
  for (int side = 0; side < 3 && !triangle.IsFull; ++side)
  {
    const LinearValue<float>& f = triangle.Sides[side];
    const auto evaluate = [&](glm::vec2 p) { return f.Value + f.SlopeX * p.x + f.SlopeY * p.y; };
    LayerPolygon clipped;
    for (int i = 0; i < polygon.Count; ++i)
    {
      const glm::vec2 p = polygon.Points[i];
      const glm::vec2 q = polygon.Points[i + 1 < polygon.Count ? i + 1 : 0];
      const float a = evaluate(p);
      const float b = evaluate(q);
      if (a >= 0.f)
      {
        clipped.Points[clipped.Count++] = p;
      }
      if ((a < 0.f) != (b < 0.f))
      {
        clipped.Points[clipped.Count++] = p + a / (a - b) * (q - p);
      }
    }
    polygon = clipped;
  }
  return polygon;
}

}
