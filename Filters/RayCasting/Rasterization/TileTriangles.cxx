// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TileTriangles.h"

#include "Embree/CoincidentSurfaces.h"
#include "Embree/RayTriangle.h"
#include "LinearValues.h"
#include "Scene.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace penumbra
{

namespace
{

/// Number of pairs of a pixel and a triangle in a tile above which its pixels are not rasterized.
constexpr std::size_t MaximumOverlaps = std::size_t(1) << 22;
/// Projected coordinates above this value have lost too much precision.
constexpr double LargestCoordinate = 1e7;

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

}

TileTriangles::TileTriangles(
  const RayScene& rays, const TileGrid& tiles, const TriangleBins& bins, int tile)
  : Rays(rays),
    Binned(bins),
    Tile(tile),
    Origin(tiles.Origin +
      static_cast<double>(tiles.Side) * glm::dvec2(tile % tiles.Count.x, tile / tiles.Count.x)),
    Side(tiles.Side)
{
}

// Adds a triangle of the tile unless its visible side is culled. Returns its projection.
ScreenTriangle TileTriangles::Add(PrimitiveId id)
{
  const Scene& scene = this->Rays.GetScene();
  const Camera& camera = scene.ViewCamera;
  const Surface& surface = scene.Surfaces[id.Surface];
  const std::array<glm::vec3, 3> corners = surface.GetPoints(id.Primitive);
  ScreenTriangle projected(corners, camera);
  TileTriangle triangle{};
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high = -low;
  projected.MoveOrigin(this->Origin);
  for (int i = 0; i < projected.Count; ++i)
  {
    low = glm::min(low, projected.Points[i]);
    high = glm::max(high, projected.Points[i]);
  }
  triangle.Low = glm::vec2(low);
  triangle.High = glm::vec2(high);
  const bool isPrecise = std::max({ -low.x, -low.y, high.x, high.y }) < LargestCoordinate;
  if (projected.IsClipped || !isPrecise)
  {
    triangle.NeedsRays = true;
    triangle.Key.Value = std::numeric_limits<double>::infinity();
  }
  else
  {
    const double area = projected.ComputeDoubleArea();
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
    triangle.Key = projected.MakeKeyPlane();
    triangle.LargestKey = std::max({ projected.Keys[0], projected.Keys[1], projected.Keys[2] });
    const TriangleBins::Visibility visibility = this->Binned.GetVisibility(id.Surface);
    triangle.IsLayer = visibility == TriangleBins::Visibility::Layers;
    triangle.IsTextured = visibility == TriangleBins::Visibility::Textured;
    triangle.NeedsRays =
      visibility == TriangleBins::Visibility::Rays || !std::isfinite(triangle.Key.Value);
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

// Returns the triangles of the tile, those of one surface in the order in which they are in front
// where all of them are in one plane.
std::vector<PrimitiveId> TileTriangles::GetFrontFirst() const
{
  const PrimitiveId* const begin = this->Binned.GetTriangles(this->Tile);
  std::vector<PrimitiveId> ids(begin, begin + this->Binned.GetCount(this->Tile));
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

void TileTriangles::Prepare()
{
  if (this->IsPrepared)
  {
    return;
  }
  this->IsPrepared = true;
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
    const ScreenTriangle projected = this->Add(ids[i]);
    if (this->Ids.size() == index)
    {
      continue;
    }
    const TileTriangle& triangle = this->Triangles.back();
    const bool hides = triangle.IsPlanar && !triangle.NeedsRays && !triangle.IsLayer;
    VisitCells(
      projected, RasterizationMargin, glm::dvec2(0.0), 1.0, glm::ivec2(this->Side), [&](int cell) {
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
  this->AlignPlanarTriangles();
  this->HasTooManyOverlaps = overlaps.size() > MaximumOverlaps;
  if (!this->HasTooManyOverlaps)
  {
    this->ByPixel.Fill(
      overlaps.size(), pixels, [&](std::size_t first, std::size_t last, const auto& add) {
        for (std::size_t i = first; i < last; ++i)
        {
          add(overlaps[i].first, overlaps[i].second);
        }
      });
  }
}

// Moves the triangles of a surface that has all triangles in one plane to the plane of its largest
// triangle. Of those that overlap, the first one of GetFrontFirst() is visible, as with rays.
void TileTriangles::AlignPlanarTriangles()
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
      if (this->Triangles[i].IsPlanar && !this->Triangles[i].NeedsRays)
      {
        this->Triangles[i].Key = key;
      }
    }
  }
}

}
