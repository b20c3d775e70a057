// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Layers in TileRasterizer: all triangles at the samples of a pixel, in the order in which rays meet
// them.
#include "TileRasterizer.h"

#include "Embree/CoincidentSurfaces.h"
#include "Scene.h"
#include "Vectorized.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace penumbra
{

namespace
{

/// Relative distance between layers up to which a ray meets only one.
constexpr double RoundingError = 0x1p-24;

constexpr float NotCovered = -std::numeric_limits<float>::infinity();

/// Stores the keys of a triangle at the samples that it covers, and NotCovered at the others.
PENUMBRA_VECTORIZED
void FindCoveredKeys(const float* __restrict xs, const float* __restrict ys, int count,
  const LinearValue<float>* sides, const LinearValue<float>& keys, float* __restrict covered)
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
    const float key = k.Value + k.SlopeX * x + k.SlopeY * y;
    covered[i] = (p >= 0.f) & (q >= 0.f) & (r >= 0.f) ? key : NotCovered;
  }
}

}

// Adds the triangles at the points of a row of cells to Candidates, sorted front to back.
void TileRasterizer::CoverRow(const SamplePoints& points, int row)
{
  const int perCell = points.GetCountPerCell();
  const int perRow = perCell * SamplePoints::CellsPerSide;
  this->CoveredKeys.resize(perRow);
  this->Candidates.resize(std::max<std::size_t>(this->Candidates.size(), perRow));
  for (int i = 0; i < perRow; ++i)
  {
    this->Candidates[i].clear();
  }
  for (const std::uint32_t index : this->LayerOrder)
  {
    const PixelTriangle& triangle = this->Selected[index];
    if (row < triangle.FirstRow || row > triangle.LastRow)
    {
      continue;
    }
    const int begin = triangle.FirstColumn * perCell;
    const int end = (triangle.LastColumn + 1) * perCell;
    const int first = row * perRow + begin;
    FindCoveredKeys(points.X.data() + first, points.Y.data() + first, end - begin, triangle.Sides,
      triangle.Key, this->CoveredKeys.data());
    for (int i = begin; i < end; ++i)
    {
      const float key = this->CoveredKeys[i - begin];
      if (key == NotCovered)
      {
        continue;
      }
      std::vector<LayerCandidate>& candidates = this->Candidates[i];
      candidates.push_back({ key, index });
      for (std::size_t at = candidates.size() - 1; at > 0 && candidates[at - 1].Key < key; --at)
      {
        std::swap(candidates[at - 1], candidates[at]);
      }
    }
  }
}

// Of triangles that single precision cannot separate from the nearest one, keeps those that a ray
// meets, in the order of CoincidentSurfaces.
void TileRasterizer::SelectCoincident(std::vector<LayerCandidate>& candidates) const
{
  const CoincidentSurfaces& surfaces = this->Rays.GetCoincidentSurfaces();
  const auto get = [&](const LayerCandidate& candidate) -> PrimitiveId {
    return this->Ids[this->Selected[candidate.Selected].Index];
  };
  // A ray continues behind a hit, whose distance is rounded.
  const auto rounding = static_cast<float>(RoundingError * std::abs(this->ReferenceKey));
  std::size_t kept = 0;
  for (std::size_t first = 0, last = 0; first < candidates.size(); first = last)
  {
    const float error = this->Selected[candidates[first].Selected].KeyError;
    for (last = first + 1; last < candidates.size(); ++last)
    {
      const float other = this->Selected[candidates[last].Selected].KeyError;
      const float both = error > 0.f && other > 0.f ? error + other : 0.f;
      if (candidates[first].Key - candidates[last].Key > std::max(both, rounding))
      {
        break;
      }
    }
    if (last - first > 1)
    {
      std::sort(candidates.begin() + static_cast<std::ptrdiff_t>(first),
        candidates.begin() + static_cast<std::ptrdiff_t>(last),
        [&](const LayerCandidate& a, const LayerCandidate& b) {
          const PrimitiveId p = get(a);
          const PrimitiveId q = get(b);
          return std::make_pair(surfaces.GetDrawOrder(p.Surface), p.Primitive) <
            std::make_pair(surfaces.GetDrawOrder(q.Surface), q.Primitive);
        });
    }
    int next = 0;
    for (std::size_t i = first; i < last; ++i)
    {
      const std::uint32_t surface = get(candidates[i]).Surface;
      if (last - first == 1 || surfaces.GetDrawOrder(surface) >= next)
      {
        next = surfaces.DepthTolerance(surface) > 0.f ? surfaces.GetNextInOrder(surface)
                                                      : std::numeric_limits<int>::max();
        candidates[kept++] = candidates[i];
      }
    }
  }
  candidates.resize(kept);
}

void TileRasterizer::FindLayers(const SamplePoints& points, SampleLayers& layers)
{
  this->LayerOrder.resize(this->Selected.size());
  std::iota(this->LayerOrder.begin(), this->LayerOrder.end(), 0u);
  const auto keyOf = [&](std::uint32_t i) {
    const LinearValue<float>& key = this->Selected[i].Key;
    return key.Value + 0.5f * (key.SlopeX + key.SlopeY);
  };
  std::sort(
    this->LayerOrder.begin(), this->LayerOrder.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::make_pair(-keyOf(a), a) < std::make_pair(-keyOf(b), b);
    });
  const bool isParallel = this->Rays.GetScene().ViewCamera.Parallel;
  const int perRow = points.GetCountPerCell() * SamplePoints::CellsPerSide;
  layers.Layers.clear();
  layers.End.clear();
  for (int row = 0; row < SamplePoints::CellsPerSide; ++row)
  {
    this->CoverRow(points, row);
    for (int i = 0; i < perRow; ++i)
    {
      this->SelectCoincident(this->Candidates[i]);
      for (const LayerCandidate& candidate : this->Candidates[i])
      {
        const PixelTriangle& triangle = this->Selected[candidate.Selected];
        const double key = this->ReferenceKey + static_cast<double>(candidate.Key);
        layers.Layers.push_back(
          { triangle.Index, static_cast<float>(isParallel ? -key : 1.0 / key) });
        if (!triangle.IsLayer)
        {
          break;
        }
      }
      layers.End.push_back(static_cast<std::uint32_t>(layers.Layers.size()));
    }
  }
}

}
