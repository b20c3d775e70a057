// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TileRasterizer.h"

#include "Embree/CoincidentSurfaces.h"
#include "Embree/RayTriangle.h"
#include "ProjectedTriangle.h"
#include "Scene.h"
#include "Surface.h"
#include "Vectorized.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace penumbra
{

namespace
{

/// Distance in pixels up to which a triangle outside a pixel is also compared with its samples.
constexpr double Margin = 1e-3;
/// Number of pairs of a pixel and a triangle in a tile above which its pixels are not rasterized.
constexpr std::size_t MaximumOverlaps = std::size_t(1) << 22;
/// Projected coordinates above this value have lost too much precision.
constexpr double LargestCoordinate = 1e7;

double Evaluate(const LinearValue<double>& f, glm::dvec2 p)
{
  return f.Value + f.SlopeX * p.x + f.SlopeY * p.y;
}

/// Returns the value relative to the origin `p`.
LinearValue<float> MoveTo(const LinearValue<double>& f, glm::dvec2 p, double offset)
{
  return { static_cast<float>(Evaluate(f, p) - offset), static_cast<float>(f.SlopeX),
    static_cast<float>(f.SlopeY) };
}

float FindMinimum(const LinearValue<float>& f)
{
  return f.Value + std::min(f.SlopeX, 0.f) + std::min(f.SlopeY, 0.f);
}

float FindMaximum(const LinearValue<float>& f)
{
  return f.Value + std::max(f.SlopeX, 0.f) + std::max(f.SlopeY, 0.f);
}

/// Returns true if the three sides of a triangle contain the pixel with the lower left corner
/// `corner`.
bool CoversPixel(const LinearValue<double>* sides, glm::dvec2 corner)
{
  return std::all_of(sides, sides + 3,
    [=](const LinearValue<double>& side) { return FindMinimum(MoveTo(side, corner, 0.0)) >= 0.f; });
}

/// Returns twice the signed area of the triangle (a, b, p) as a function of p. The value of (b, a)
/// is exactly the negative one, so that adjacent triangles leave no gap.
LinearValue<double> MakeSide(glm::dvec2 a, glm::dvec2 b)
{
  const bool isReversed = std::tie(b.x, b.y) < std::tie(a.x, a.y);
  if (isReversed)
  {
    std::swap(a, b);
  }
  const glm::dvec2 d = b - a;
  const LinearValue<double> f{ d.y * a.x - d.x * a.y, -d.y, d.x };
  return isReversed ? LinearValue<double>{ -f.Value, -f.SlopeX, -f.SlopeY } : f;
}

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

TileRasterizer::TileRasterizer(
  const RayScene& rays, const TileGrid& tiles, const TriangleBins& bins, int tile)
  : Rays(rays),
    Bins(bins),
    Tile(tile),
    Origin(tiles.Origin +
      static_cast<double>(tiles.Side) * glm::dvec2(tile % tiles.Count.x, tile / tiles.Count.x)),
    Side(tiles.Side),
    IsParallel(rays.GetScene().ViewCamera.Parallel)
{
}

bool TileRasterizer::RequiresRays(const Scene& scene)
{
  return std::any_of(scene.Surfaces.begin(), scene.Surfaces.end(),
    [](const Surface& surface) { return surface.Instances != nullptr; });
}

// Adds a triangle of the tile unless its visible side is culled. Returns its projection.
ProjectedTriangle TileRasterizer::AddTriangle(PrimitiveId id)
{
  const Scene& scene = this->Rays.GetScene();
  const Camera& camera = scene.ViewCamera;
  const Surface& surface = scene.Surfaces[id.Surface];
  const std::array<glm::vec3, 3> corners = surface.GetPoints(id.Primitive);
  ProjectedTriangle projected(corners, camera);
  TileTriangle triangle{};
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high = -low;
  for (int i = 0; i < projected.Count; ++i)
  {
    projected.Points[i] -= this->Origin;
    low = glm::min(low, projected.Points[i]);
    high = glm::max(high, projected.Points[i]);
  }
  triangle.Low = glm::vec2(low);
  triangle.High = glm::vec2(high);
  const bool isPrecise = std::max({ -low.x, -low.y, high.x, high.y }) < LargestCoordinate;
  if (projected.IsClipped || !isPrecise)
  {
    triangle.IsComplex = true;
    triangle.Key.Value = std::numeric_limits<double>::infinity();
  }
  else
  {
    const auto& [a, b, c, unused] = projected.Points;
    const glm::dvec2 ab = b - a;
    const glm::dvec2 ac = c - a;
    const double area = ab.x * ac.y - ab.y * ac.x;
    if (area == 0.0 || !(area > 0.0 ? surface.Frontfaces : surface.Backfaces))
    {
      return projected;
    }
    for (int i = 0; i < 3; ++i)
    {
      const glm::dvec2 from = projected.Points[area > 0.0 ? i : (i + 1) % 3];
      const glm::dvec2 to = projected.Points[area > 0.0 ? (i + 1) % 3 : i];
      triangle.Sides[i] = MakeSide(from, to);
    }
    const double u = projected.Keys[1] - projected.Keys[0];
    const double v = projected.Keys[2] - projected.Keys[0];
    triangle.Key.SlopeX = (u * ac.y - v * ab.y) / area;
    triangle.Key.SlopeY = (v * ab.x - u * ac.x) / area;
    triangle.Key.Value = projected.Keys[0] - triangle.Key.SlopeX * a.x - triangle.Key.SlopeY * a.y;
    triangle.IsLayer = this->Bins.IsLayer(id.Surface);
    triangle.IsTextured = this->Bins.IsTextured(id.Surface);
    triangle.IsComplex =
      (this->Bins.IsComplex(id.Surface) && !triangle.IsLayer && !triangle.IsTextured) ||
      !std::isfinite(triangle.Key.Value);
    triangle.IsPlanar = this->Rays.GetCells(id.Surface) != nullptr;
    triangle.Area = std::abs(area);
    if (this->Rays.GetCoincidentSurfaces().DepthTolerance(id.Surface) > 0.f)
    {
      // In perspective, an error e of the depth d changes 1 / d by e / d^2.
      const glm::dvec3 p(corners[0]);
      const glm::dvec3 q(corners[1]);
      const glm::dvec3 r(corners[2]);
      const glm::dvec3 farthest = glm::max(glm::abs(p), glm::max(glm::abs(q), glm::abs(r)));
      const glm::dvec3 normal = glm::cross(q - p, r - p);
      const double facing =
        std::abs(glm::dot(normal, camera.Parallel ? camera.Forward : p - camera.Position));
      triangle.KeyError =
        facing > 0.0 ? HalfUlp * glm::length(farthest) * glm::length(normal) / facing : 0.0;
    }
  }
  this->Ids.push_back(id);
  this->Triangles.push_back(triangle);
  return projected;
}

// Sorts the triangles by pixels.
void TileRasterizer::BinTriangles(
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& overlaps)
{
  this->Begin.assign(static_cast<std::size_t>(this->Side) * this->Side + 1, 0);
  for (const auto& [cell, triangle] : overlaps)
  {
    ++this->Begin[cell + 1];
  }
  for (std::size_t cell = 1; cell < this->Begin.size(); ++cell)
  {
    this->Begin[cell] += this->Begin[cell - 1];
  }
  this->Listed.resize(overlaps.size());
  std::vector<std::uint32_t> next(this->Begin.begin(), this->Begin.end() - 1);
  for (const auto& [cell, triangle] : overlaps)
  {
    this->Listed[next[cell]++] = triangle;
  }
}

// Returns the triangles of the tile, those of one surface in the order in which they are in front
// where all of them are in one plane.
std::vector<PrimitiveId> TileRasterizer::GetFrontFirst() const
{
  const PrimitiveId* const begin = this->Bins.GetTriangles(this->Tile);
  std::vector<PrimitiveId> ids(begin, begin + this->Bins.GetCount(this->Tile));
  const CoincidentSurfaces& surfaces = this->Rays.GetCoincidentSurfaces();
  auto last = ids.begin();
  for (auto first = ids.begin(); first != ids.end(); first = last)
  {
    const std::uint32_t surface = first->Surface;
    last =
      std::find_if(first, ids.end(), [=](const PrimitiveId& id) { return id.Surface != surface; });
    if (surfaces.IsLastInFront(surface) && this->Rays.GetCells(surface))
    {
      std::reverse(first, last);
    }
  }
  return ids;
}

void TileRasterizer::Prepare()
{
  const std::vector<PrimitiveId> ids = this->GetFrontFirst();
  const std::size_t count = ids.size();
  this->Ids.reserve(count);
  this->Triangles.reserve(count);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> overlaps; // pixel and triangle
  overlaps.reserve(2 * count);
  // Pixels that a triangle of the current surface covers, if all its triangles are in one plane.
  // Later triangles of this surface are hidden there.
  const std::size_t pixels = static_cast<std::size_t>(this->Side) * this->Side;
  std::vector<char> covered(pixels, 0);
  std::size_t numberCovered = 0;
  for (std::size_t i = 0; i < count && overlaps.size() <= MaximumOverlaps; ++i)
  {
    if (i == 0 || ids[i].Surface != ids[i - 1].Surface)
    {
      covered.assign(pixels, 0);
      numberCovered = 0;
    }
    if (numberCovered == pixels)
    {
      continue;
    }
    const auto index = static_cast<std::uint32_t>(this->Ids.size());
    const ProjectedTriangle projected = this->AddTriangle(ids[i]);
    if (this->Ids.size() == index)
    {
      continue;
    }
    const TileTriangle& triangle = this->Triangles.back();
    const bool hides = triangle.IsPlanar && !triangle.IsComplex && !triangle.IsLayer;
    VisitCells(projected, Margin, glm::dvec2(0.0), 1.0, glm::ivec2(this->Side), [&](int cell) {
      if (covered[cell])
      {
        return;
      }
      overlaps.emplace_back(cell, index);
      if (hides && CoversPixel(triangle.Sides, glm::dvec2(cell % this->Side, cell / this->Side)))
      {
        covered[cell] = 1;
        ++numberCovered;
      }
    });
  }
  this->IsOverfull = overlaps.size() > MaximumOverlaps;
  if (this->IsOverfull)
  {
    overlaps.clear();
  }
  this->AlignPlanarTriangles();
  this->BinTriangles(overlaps);
  this->IsPrepared = true;
}

// Moves the triangles of a surface that has all triangles in one plane to the plane of its largest
// triangle. Of those that overlap, the first one of GetFrontFirst() is visible, as with rays.
void TileRasterizer::AlignPlanarTriangles()
{
  std::size_t end = 0;
  for (std::size_t first = 0; first < this->Ids.size(); first = end)
  {
    std::size_t largest = first;
    for (end = first; end < this->Ids.size() && this->Ids[end].Surface == this->Ids[first].Surface;
         ++end)
    {
      largest = this->Triangles[end].Area > this->Triangles[largest].Area ? end : largest;
    }
    const LinearValue<double> key = this->Triangles[largest].Key;
    for (std::size_t i = first; i < end; ++i)
    {
      if (this->Triangles[i].IsPlanar && !this->Triangles[i].IsComplex)
      {
        this->Triangles[i].Key = key;
      }
    }
  }
}

// Adds a triangle to the selected pixel. Returns false if it does not overlap the pixel.
bool TileRasterizer::AddToPixel(std::uint32_t index, glm::dvec2 corner)
{
  const TileTriangle& triangle = this->Triangles[index];
  PixelTriangle& added = this->Selected.emplace_back();
  added.Index = index;
  added.IsComplex = triangle.IsComplex;
  added.IsLayer = triangle.IsLayer;
  added.IsTextured = triangle.IsTextured;
  const bool isBounded = std::isfinite(triangle.Key.Value);
  added.IsFull = isBounded;
  for (int i = 0; i < 3 && isBounded; ++i)
  {
    added.Sides[i] = MoveTo(triangle.Sides[i], corner, 0.0);
    if (FindMaximum(added.Sides[i]) < 0.f)
    {
      this->Selected.pop_back();
      return false;
    }
    added.IsFull = added.IsFull && FindMinimum(added.Sides[i]) >= 0.f;
  }
  const auto findCell = [](float x) {
    return static_cast<std::uint8_t>(
      std::clamp(x * SamplePoints::CellsPerSide, 0.f, SamplePoints::CellsPerSide - 1.f));
  };
  const glm::vec2 low = triangle.Low - glm::vec2(corner) - static_cast<float>(Margin);
  const glm::vec2 high = triangle.High - glm::vec2(corner) + static_cast<float>(Margin);
  added.FirstColumn = findCell(low.x);
  added.LastColumn = findCell(high.x);
  added.FirstRow = findCell(low.y);
  added.LastRow = findCell(high.y);
  this->Keys.push_back(
    isBounded ? Evaluate(triangle.Key, corner + 0.5) : std::numeric_limits<double>::infinity());
  added.KeyError =
    static_cast<float>(triangle.KeyError * (this->IsParallel ? 1.0 : std::abs(this->Keys.back())));
  return true;
}

bool TileRasterizer::SelectPixel(glm::ivec2 pixel)
{
  if (!this->IsPrepared)
  {
    this->Prepare();
  }
  if (pixel == this->SelectedPixel)
  {
    return !this->IsComplex;
  }
  this->SelectedPixel = pixel;
  this->IsComplex = this->IsOverfull;
  this->IsLayered = false;
  if (this->IsOverfull)
  {
    return false;
  }
  const glm::ivec2 local = pixel - glm::ivec2(this->Origin);
  const std::size_t cell = static_cast<std::size_t>(local.y) * this->Side + local.x;
  const glm::dvec2 corner(local);
  this->Selected.clear();
  this->Keys.clear();
  double reference = -std::numeric_limits<double>::infinity();
  std::uint32_t covered = None; // surface in one plane of which a triangle covers the pixel
  for (std::uint32_t i = this->Begin[cell]; i < this->Begin[cell + 1]; ++i)
  {
    const std::uint32_t index = this->Listed[i];
    const std::uint32_t surface = this->Ids[index].Surface;
    if (surface != covered && this->AddToPixel(index, corner) && std::isfinite(this->Keys.back()))
    {
      reference = std::max(reference, this->Keys.back());
      covered = this->Triangles[index].IsPlanar && this->Selected.back().IsFull ? surface : covered;
    }
  }
  // Keys relative to the nearest one are precise where surfaces are close to each other.
  float nearestFull = -std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < this->Selected.size(); ++i)
  {
    PixelTriangle& selected = this->Selected[i];
    selected.LargestKey = std::numeric_limits<float>::infinity();
    if (std::isfinite(this->Keys[i]))
    {
      selected.Key = MoveTo(this->Triangles[selected.Index].Key, corner, reference);
      selected.LargestKey = FindMaximum(selected.Key);
      if (selected.IsFull && !selected.IsLayer)
      {
        nearestFull = std::max(nearestFull, FindMinimum(selected.Key) - selected.KeyError);
      }
    }
  }
  this->Selected.erase(std::remove_if(this->Selected.begin(), this->Selected.end(),
                         [=](const PixelTriangle& triangle) {
                           return triangle.LargestKey + triangle.KeyError < nearestFull;
                         }),
    this->Selected.end());
  this->IsComplex = false;
  this->MayCoincide = false;
  const CoincidentSurfaces& surfaces = this->Rays.GetCoincidentSurfaces();
  std::uint32_t coincident = None;
  for (const PixelTriangle& triangle : this->Selected)
  {
    this->IsComplex = this->IsComplex || triangle.IsComplex;
    if (triangle.KeyError > 0.f)
    {
      const std::uint32_t surface = this->Ids[triangle.Index].Surface;
      this->MayCoincide = this->MayCoincide ||
        (coincident != None && (coincident != surface || surfaces.IsLastInFront(surface)));
      coincident = surface;
    }
  }
  this->ReferenceKey = reference;
  this->IsLayered = !this->IsComplex &&
    std::any_of(this->Selected.begin(), this->Selected.end(),
      [](const PixelTriangle& triangle) { return triangle.IsLayer || triangle.IsTextured; });
  this->IsComplex = this->IsComplex || this->IsLayered;
  return !this->IsComplex;
}

void TileRasterizer::Rasterize(const SamplePoints& points, std::vector<std::uint32_t>& visible)
{
  const int count = points.GetCount();
  const int perCell = points.GetCountPerCell();
  this->Nearest.assign(count, -std::numeric_limits<float>::infinity());
  this->Found.assign(count, -1);
  if (this->MayCoincide)
  {
    this->CoverCoincident(points);
  }
  for (std::size_t i = 0; i < this->Selected.size() && !this->MayCoincide; ++i)
  {
    const PixelTriangle& triangle = this->Selected[i];
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
    visible[i] = this->Found[i] < 0 ? None : this->Selected[this->Found[i]].Index;
  }
}

// Finds the triangles at samples where single precision cannot separate some from the nearest one. Of
// these, the first one in the order of CoincidentSurfaces is visible: each replaces those behind it.
void TileRasterizer::CoverCoincident(const SamplePoints& points)
{
  const int perCell = points.GetCountPerCell();
  const CoincidentSurfaces& surfaces = this->Rays.GetCoincidentSurfaces();
  std::vector<std::uint32_t> order(this->Selected.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const PrimitiveId p = this->Ids[this->Selected[a].Index];
    const PrimitiveId q = this->Ids[this->Selected[b].Index];
    return surfaces.IsInFront(q.Surface, q.Primitive, p.Surface, p.Primitive);
  });
  this->Errors.assign(points.GetCount(), -std::numeric_limits<float>::infinity());
  for (const std::uint32_t i : order)
  {
    const PixelTriangle& triangle = this->Selected[i];
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
