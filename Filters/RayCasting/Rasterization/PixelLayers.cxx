// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PixelLayers.h"

#include "Embree/CoincidentSurfaces.h"
#include "Execution/Vectorized.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

namespace
{

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

void PixelLayers::SortTriangles(const PixelTriangles& pixel)
{
  this->Order.clear();
  this->Errors.clear();
  this->LargestError = 0.f;
  this->HasOpaqueTriangles = false;
  for (const PixelTriangle& triangle : pixel.Get())
  {
    const LinearValue<float>& key = triangle.Key;
    this->Order.push_back({ key.Value + 0.5f * (key.SlopeX + key.SlopeY),
      static_cast<std::uint32_t>(this->Order.size()) });
    this->Errors.push_back(triangle.KeyError);
    this->LargestError = std::max(this->LargestError, triangle.KeyError);
    this->HasOpaqueTriangles = this->HasOpaqueTriangles || !triangle.IsLayer;
  }
  std::sort(
    this->Order.begin(), this->Order.end(), [](const LayerCandidate& a, const LayerCandidate& b) {
      return a.Key != b.Key ? a.Key > b.Key : a.Layer < b.Layer;
    });
}

// Finds the candidates at the points of some rows of cells.
void PixelLayers::CoverRows(
  const PixelTriangles& pixel, const SamplePoints& points, int firstRow, int rows)
{
  const int perCell = points.GetCountPerCell();
  const int perRow = perCell * SamplePoints::CellsPerSide;
  const int lastRow = firstRow + rows - 1;
  const std::size_t stride = pixel.Get().size();
  const std::size_t count = static_cast<std::size_t>(rows) * perRow;
  this->Keys.resize(count);
  this->Sides.resize(count);
  // One more, because a candidate is written before it is known to be one.
  this->Candidates.resize(std::max(this->Candidates.size(), count * stride + 1));
  this->CandidateCounts.assign(count, 0);
  for (const LayerCandidate& layer : this->Order)
  {
    const std::uint32_t index = layer.Layer;
    const PixelTriangle& triangle = pixel.Get()[index];
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
      triangle.Key, this->Keys.data(), this->Sides.data());
    for (int i = begin; i < end; ++i)
    {
      std::uint32_t& number = this->CandidateCounts[i];
      this->Candidates[i * stride + number] = { this->Keys[i - begin], index };
      number += this->Sides[i - begin] >= 0.f ? 1 : 0;
    }
  }
}

// Sorts the candidates of a point. Returns the end of those that are layers.
LayerCandidate* PixelLayers::SelectLayers(
  const PixelTriangles& pixel, LayerCandidate* begin, LayerCandidate* end) const
{
  // A ray continues behind a hit, whose distance is rounded.
  const float rounding = pixel.ComputeRayRounding();
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
  if (gap <= std::max(2.f * this->LargestError, rounding))
  {
    end = this->SelectCoincident(pixel, begin, end);
  }
  if (!this->HasOpaqueTriangles)
  {
    return end;
  }
  for (LayerCandidate* next = begin; next < end; ++next)
  {
    if (!pixel.Get()[next->Layer].IsLayer)
    {
      return next + 1;
    }
  }
  return end;
}

// Of triangles that single precision cannot separate from the nearest one, keeps those that a ray
// meets, in the order of CoincidentSurfaces.
LayerCandidate* PixelLayers::SelectCoincident(
  const PixelTriangles& pixel, LayerCandidate* begin, LayerCandidate* end) const
{
  const CoincidentSurfaces& surfaces = pixel.GetCoincidentSurfaces();
  const float rounding = pixel.ComputeRayRounding();
  LayerCandidate* kept = begin;
  for (LayerCandidate *first = begin, *last = begin; first < end; first = last)
  {
    const float error = this->Errors[first->Layer];
    for (last = first + 1; last < end; ++last)
    {
      const float other = this->Errors[last->Layer];
      const float both = error > 0.f && other > 0.f ? error + other : 0.f;
      if (first->Key - last->Key > std::max(both, rounding))
      {
        break;
      }
    }
    if (last - first > 1)
    {
      std::sort(first, last, [&](const LayerCandidate& a, const LayerCandidate& b) {
        const PrimitiveId p = pixel.GetId(a.Layer);
        const PrimitiveId q = pixel.GetId(b.Layer);
        return surfaces.IsInFront(p.Surface, p.Primitive, q.Surface, q.Primitive);
      });
    }
    int next = 0;
    for (const LayerCandidate* candidate = first; candidate < last; ++candidate)
    {
      const std::uint32_t surface = pixel.GetId(candidate->Layer).Surface;
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

}
