// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "NearestTriangles.h"

#include "Embree/CoincidentSurfaces.h"
#include "Execution/Vectorized.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace penumbra
{

namespace
{

struct SampleRange
{
  const float* X;
  const float* Y;
  int Count;
};

/// Stores `index` and the key of a triangle at the samples that it covers and where it is nearest.
PENUMBRA_VECTORIZED
void CoverSamples(SampleRange samples, const LinearValue<float>* sides,
  const LinearValue<float>& keys, std::int32_t index, float* __restrict nearest,
  std::int32_t* __restrict found)
{
  const LinearValue<float> a = sides[0];
  const LinearValue<float> b = sides[1];
  const LinearValue<float> c = sides[2];
  const LinearValue<float> k = keys;
  for (int i = 0; i < samples.Count; ++i)
  {
    const float x = samples.X[i];
    const float y = samples.Y[i];
    const float p = a.Value + a.SlopeX * x + a.SlopeY * y;
    const float q = b.Value + b.SlopeX * x + b.SlopeY * y;
    const float r = c.Value + c.SlopeX * x + c.SlopeY * y;
    const float key = k.Value + k.SlopeX * x + k.SlopeY * y;
    const bool isNearest = (p >= 0.f) & (q >= 0.f) & (r >= 0.f) & (key > nearest[i]);
    nearest[i] = isNearest ? key : nearest[i];
    found[i] = isNearest ? index : found[i];
  }
}

/// The same for a triangle that covers all samples.
PENUMBRA_VECTORIZED
void CoverAllSamples(SampleRange samples, const LinearValue<float>& keys, std::int32_t index,
  float* __restrict nearest, std::int32_t* __restrict found)
{
  const LinearValue<float> k = keys;
  for (int i = 0; i < samples.Count; ++i)
  {
    const float key = k.Value + k.SlopeX * samples.X[i] + k.SlopeY * samples.Y[i];
    const bool isNearest = key > nearest[i];
    nearest[i] = isNearest ? key : nearest[i];
    found[i] = isNearest ? index : found[i];
  }
}

/// Stores `index` at the samples that a triangle covers and where it is nearest, or coincides with the
/// nearest one. `error`: its KeyError, or minus infinity if it cannot coincide with others. `errors`:
/// those of the nearest triangles.
PENUMBRA_VECTORIZED
void CoverCoincidentSamples(SampleRange samples, const LinearValue<float>* sides,
  const LinearValue<float>& keys, float error, std::int32_t index, float* __restrict nearest,
  float* __restrict errors, std::int32_t* __restrict found)
{
  const LinearValue<float> a = sides[0];
  const LinearValue<float> b = sides[1];
  const LinearValue<float> c = sides[2];
  const LinearValue<float> k = keys;
  for (int i = 0; i < samples.Count; ++i)
  {
    const float x = samples.X[i];
    const float y = samples.Y[i];
    const float p = a.Value + a.SlopeX * x + a.SlopeY * y;
    const float q = b.Value + b.SlopeX * x + b.SlopeY * y;
    const float r = c.Value + c.SlopeX * x + c.SlopeY * y;
    const float key = k.Value + k.SlopeX * x + k.SlopeY * y;
    const bool isInside = (p >= 0.f) & (q >= 0.f) & (r >= 0.f);
    const bool isNearest = isInside & (key > nearest[i]);
    const bool isInFront = isNearest | (isInside & (nearest[i] - key <= error + errors[i]));
    nearest[i] = isNearest ? key : nearest[i];
    errors[i] = isNearest ? error : errors[i];
    found[i] = isInFront ? index : found[i];
  }
}

}

void NearestTriangles::Find(
  const PixelTriangles& pixel, const SamplePoints& points, std::vector<std::uint32_t>& visible)
{
  const std::vector<PixelTriangle>& selected = pixel.Get();
  const int count = points.GetCount();
  const int perCell = points.GetCountPerCell();
  this->Nearest.assign(count, -std::numeric_limits<float>::infinity());
  this->Found.assign(count, -1);
  if (pixel.HasCoincidentSurfaces())
  {
    this->CoverCoincident(pixel, points);
  }
  for (std::size_t i = 0; i < selected.size() && !pixel.HasCoincidentSurfaces(); ++i)
  {
    const PixelTriangle& triangle = selected[i];
    const auto index = static_cast<std::int32_t>(i);
    if (triangle.IsFull)
    {
      CoverAllSamples({ points.X.data(), points.Y.data(), count }, triangle.Key, index,
        this->Nearest.data(), this->Found.data());
      continue;
    }
    const int width = (triangle.LastColumn - triangle.FirstColumn + 1) * perCell;
    for (int row = triangle.FirstRow; row <= triangle.LastRow; ++row)
    {
      const int first = (row * SamplePoints::CellsPerSide + triangle.FirstColumn) * perCell;
      CoverSamples({ points.X.data() + first, points.Y.data() + first, width }, triangle.Sides,
        triangle.Key, index, this->Nearest.data() + first, this->Found.data() + first);
    }
  }
  visible.resize(count);
  for (int i = 0; i < count; ++i)
  {
    visible[i] = this->Found[i] < 0 ? None : selected[this->Found[i]].Index;
  }
}

// Finds the triangles at samples where single precision cannot separate some from the nearest one. Of
// these, the first one in the order of CoincidentSurfaces is visible: each replaces those behind it.
void NearestTriangles::CoverCoincident(const PixelTriangles& pixel, const SamplePoints& points)
{
  const int perCell = points.GetCountPerCell();
  const std::vector<PixelTriangle>& selected = pixel.Get();
  const CoincidentSurfaces& surfaces = pixel.GetCoincidentSurfaces();
  std::vector<std::uint32_t> order(selected.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const PrimitiveId p = pixel.GetId(a);
    const PrimitiveId q = pixel.GetId(b);
    return surfaces.IsInFront(q.Surface, q.Primitive, p.Surface, p.Primitive);
  });
  this->Errors.assign(points.GetCount(), -std::numeric_limits<float>::infinity());
  for (const std::uint32_t i : order)
  {
    const PixelTriangle& triangle = selected[i];
    const float error =
      triangle.KeyError > 0.f ? triangle.KeyError : -std::numeric_limits<float>::infinity();
    const int width = (triangle.LastColumn - triangle.FirstColumn + 1) * perCell;
    for (int row = triangle.FirstRow; row <= triangle.LastRow; ++row)
    {
      const int first = (row * SamplePoints::CellsPerSide + triangle.FirstColumn) * perCell;
      CoverCoincidentSamples({ points.X.data() + first, points.Y.data() + first, width },
        triangle.Sides, triangle.Key, error, static_cast<std::int32_t>(i),
        this->Nearest.data() + first, this->Errors.data() + first, this->Found.data() + first);
    }
  }
}

}
