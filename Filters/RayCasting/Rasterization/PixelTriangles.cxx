// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PixelTriangles.h"

#include "Embree/CoincidentSurfaces.h"
#include "LinearValues.h"
#include "SamplePoints.h"
#include "Scene.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

namespace
{
constexpr std::uint32_t None = 0xffffffffu;
/// Relative distance between layers up to which a ray meets only one.
constexpr double RoundingError = 0x1p-24;
}

PixelTriangles::PixelTriangles(TileTriangles& tile)
  : Tile(tile),
    IsParallel(tile.GetRays().GetScene().ViewCamera.Parallel)
{
}

bool PixelTriangles::Select(glm::ivec2 pixel)
{
  this->Tile.Prepare();
  if (pixel == this->SelectedPixel)
  {
    return !this->NeedsRays;
  }
  this->SelectedPixel = pixel;
  this->NeedsRays = this->Tile.IsOverfull();
  this->IsLayered = false;
  if (!this->NeedsRays)
  {
    const glm::ivec2 local = this->Tile.GetLocal(pixel);
    this->AddAll(this->Tile.GetBin(local), glm::dvec2(local));
    this->RemoveHidden(glm::dvec2(local));
    this->FindKind();
  }
  return !this->NeedsRays;
}

void PixelTriangles::AddAll(std::size_t bin, glm::dvec2 corner)
{
  this->Selected.clear();
  this->Keys.clear();
  this->ReferenceKey = -std::numeric_limits<double>::infinity();
  std::uint32_t covered = None; // surface in one plane of which a triangle covers the pixel
  const std::uint32_t* const listed = this->Tile.GetPixels().Get(bin);
  const std::size_t count = this->Tile.GetPixels().GetCount(bin);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint32_t index = listed[i];
    const std::uint32_t surface = this->Tile.GetId(index).Surface;
    if (surface != covered && this->Add(index, corner) && std::isfinite(this->Keys.back()))
    {
      this->ReferenceKey = std::max(this->ReferenceKey, this->Keys.back());
      covered = this->Tile.Get(index).IsPlanar && this->Selected.back().IsFull ? surface : covered;
    }
  }
}

// Adds a triangle. Returns false if it does not overlap the pixel.
bool PixelTriangles::Add(std::uint32_t index, glm::dvec2 corner)
{
  const TileTriangle& triangle = this->Tile.Get(index);
  PixelTriangle& added = this->Selected.emplace_back();
  added.Index = index;
  added.NeedsRays = triangle.NeedsRays;
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
  const glm::vec2 low = triangle.Low - glm::vec2(corner) - static_cast<float>(RasterizationMargin);
  const glm::vec2 high =
    triangle.High - glm::vec2(corner) + static_cast<float>(RasterizationMargin);
  added.FirstColumn = findCell(low.x);
  added.LastColumn = findCell(high.x);
  added.FirstRow = findCell(low.y);
  added.LastRow = findCell(high.y);
  // At the center of the pixel, the plane of a triangle that is seen edge-on may be far in front of it.
  this->Keys.push_back(isBounded
      ? std::min(Evaluate(triangle.Key, corner + 0.5), triangle.LargestKey)
      : std::numeric_limits<double>::infinity());
  added.KeyError =
    static_cast<float>(triangle.KeyError * (this->IsParallel ? 1.0 : std::abs(this->Keys.back())));
  return true;
}

void PixelTriangles::RemoveHidden(glm::dvec2 corner)
{
  // Keys relative to the nearest one are precise where surfaces are close to each other.
  float nearestFull = -std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < this->Selected.size(); ++i)
  {
    PixelTriangle& selected = this->Selected[i];
    selected.LargestKey = std::numeric_limits<float>::infinity();
    if (std::isfinite(this->Keys[i]))
    {
      selected.Key = MoveTo(this->Tile.Get(selected.Index).Key, corner, this->ReferenceKey);
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
}

void PixelTriangles::FindKind()
{
  this->NeedsRays = false;
  this->MayCoincide = false;
  const CoincidentSurfaces& surfaces = this->GetCoincidentSurfaces();
  std::uint32_t coincident = None;
  for (const PixelTriangle& triangle : this->Selected)
  {
    this->NeedsRays = this->NeedsRays || triangle.NeedsRays;
    if (triangle.KeyError > 0.f)
    {
      const std::uint32_t surface = this->Tile.GetId(triangle.Index).Surface;
      this->MayCoincide = this->MayCoincide ||
        (coincident != None && (coincident != surface || surfaces.IsLastInFront(surface)));
      coincident = surface;
    }
  }
  this->IsLayered = !this->NeedsRays &&
    std::any_of(this->Selected.begin(), this->Selected.end(),
      [](const PixelTriangle& triangle) { return triangle.IsLayer || triangle.IsTextured; });
  this->NeedsRays = this->NeedsRays || this->IsLayered;
}

bool PixelTriangles::HasLines() const
{
  const std::vector<Surface>& surfaces = this->Tile.GetRays().GetSurfaces();
  return std::any_of(
    this->Selected.begin(), this->Selected.end(), [&](const PixelTriangle& triangle) {
      return surfaces[this->Tile.GetId(triangle.Index).Surface].IsLineOrPoint;
    });
}

// In perspective, an error e of the depth d changes 1 / d by e / d^2. Rays begin near the scene, so that
// their distances are less than depths.
float PixelTriangles::ComputeRayRounding() const
{
  const double key = std::abs(this->ReferenceKey);
  const double origin = this->Tile.GetRays().GetScene().ViewCamera.DepthOfRayOrigins();
  return static_cast<float>(RoundingError * key * std::abs(1.0 - origin * key));
}

LayerPolygon PixelTriangles::Clip(std::uint32_t index) const
{
  const PixelTriangle& triangle = this->Selected[index];
  LayerPolygon polygon{ { { { 0.f, 0.f }, { 1.f, 0.f }, { 1.f, 1.f }, { 0.f, 1.f } } }, 4 };
  for (int side = 0; side < 3 && !triangle.IsFull; ++side)
  {
    const LinearValue<float>& f = triangle.Sides[side];
    const auto evaluate = [&](glm::vec2 p) { return f.Value + f.SlopeX * p.x + f.SlopeY * p.y; };
    LayerPolygon outside;
    LayerPolygon inside;
    Split(polygon, evaluate, outside, inside);
    polygon = inside;
  }
  return polygon;
}

}
