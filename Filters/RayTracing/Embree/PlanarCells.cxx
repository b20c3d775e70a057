// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanarCells.h"

#include "BoxOverlap.h"
#include "RayTriangle.h"
#include "Surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace penumbra
{

namespace
{

/// Mean number of triangles over a point of the bounds from which cells are tried.
constexpr double MinimumDepth = 16.0;
/// Number of triangles from which a cell is split.
constexpr std::size_t LeafSize = 8;
constexpr int MaximumLevel = 14;
/// Limits per triangle of the surface, beyond which cells are not used: tests of a triangle against
/// a cell, and triangles in the lists of all cells. Random polygons of 1,000 to 1,000,000 corners
/// need at most 67 and 8.2 (measured).
constexpr std::size_t MaximumTests = 256;
constexpr std::size_t MaximumListed = 16;

/// The points with dot(Normal, p) = Offset. The normal has unit length.
struct Plane
{
  glm::dvec3 Normal{ 0.0 };
  double Offset = 0.0;
};

glm::dvec3 GetCorner(const Surface& surface, const glm::uvec3& triangle, int corner)
{
  return glm::dvec3(surface.Positions[triangle[corner]]);
}

/// Returns the plane of the largest triangle; its normal is 0 if all areas are.
Plane FindPlane(const Surface& surface)
{
  Plane plane;
  double largest = 0.0;
  for (const glm::uvec3& triangle : surface.Triangles)
  {
    const glm::dvec3 a = GetCorner(surface, triangle, 0);
    const glm::dvec3 normal =
      glm::cross(GetCorner(surface, triangle, 1) - a, GetCorner(surface, triangle, 2) - a);
    const double area = glm::length(normal);
    if (area > largest)
    {
      largest = area;
      plane.Normal = normal / area;
      plane.Offset = glm::dot(plane.Normal, a);
    }
  }
  return plane;
}

/// Returns the bound of the rounding errors of positions and hits, in scene units.
double ComputeSlack(const Surface& surface)
{
  double extent = 0.0;
  for (const glm::uvec3& triangle : surface.Triangles)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const glm::dvec3 p = glm::abs(GetCorner(surface, triangle, corner));
      extent = std::max({ extent, p.x, p.y, p.z });
    }
  }
  return MaximumRoundings * HalfUlp * extent;
}

bool IsInPlane(const Surface& surface, const Plane& plane, double slack)
{
  const auto isNear = [&](std::uint32_t corner) {
    const double height =
      glm::dot(plane.Normal, glm::dvec3(surface.Positions[corner])) - plane.Offset;
    return std::abs(height) <= 0.5 * slack; // false for NaN
  };
  return std::all_of(surface.Triangles.begin(), surface.Triangles.end(),
    [&](const glm::uvec3& t) { return isNear(t.x) && isNear(t.y) && isNear(t.z); });
}

}

/// Splits the bounds of a surface into quarters until few triangles are listed per cell. Works in
/// the projection along the axis that is closest to the normal.
class PlanarCellBuilder
{
public:
  PlanarCellBuilder(const Surface& surface, const Plane& plane, double slack)
    : SurfacePlane(plane),
      Slack(slack),
      IsLastInFront(!surface.CellColors.empty())
  {
    const glm::dvec3 size = glm::abs(plane.Normal);
    this->Up = size.z >= std::max(size.x, size.y) ? 2 : size.y >= size.x ? 1 : 0;
    for (const glm::uvec3& triangle : surface.Triangles)
    {
      Corners corners;
      for (int i = 0; i < 3; ++i)
      {
        const glm::dvec3 p = GetCorner(surface, triangle, i);
        corners[i] = { p[this->GetAxis(0)], p[this->GetAxis(1)] };
      }
      const glm::dvec2 ab = corners[1] - corners[0];
      const glm::dvec2 ac = corners[2] - corners[0];
      if (ab.x * ac.y < ab.y * ac.x)
      {
        std::swap(corners[1], corners[2]);
      }
      this->Projected.push_back(corners);
    }
  }

  /// Returns null if there are too many cells.
  std::shared_ptr<const PlanarCells> Build()
  {
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high(-low);
    std::vector<std::uint32_t> all;
    const auto count = static_cast<std::uint32_t>(this->Projected.size());
    for (std::uint32_t i = 0; i < count; ++i)
    {
      all.push_back(this->IsLastInFront ? count - 1 - i : i);
      for (const glm::dvec2& corner : this->Projected[i])
      {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
      }
    }
    this->Cells = std::make_shared<PlanarCells>();
    return this->Split({ 0.5 * (low + high), 0.5 * (high - low) }, all, 0) ? this->Cells : nullptr;
  }

private:
  using Corners = std::array<glm::dvec2, 3>; ///< counterclockwise
  struct Rectangle
  {
    glm::dvec2 Center;
    glm::dvec2 Half;
  };
  enum class Overlaps
  {
    Disjoint,
    Partial,
    Covering
  };

  /// Returns the i-th axis of the projection.
  int GetAxis(int i) const { return (this->Up + 1 + i) % 3; }

  /// Compares a triangle with a rectangle, enlarged by the slack.
  Overlaps Compare(const Corners& triangle, const Rectangle& rectangle) const
  {
    const glm::dvec2 half = rectangle.Half + 2.0 * this->Slack;
    const glm::dvec2 low = glm::min(glm::min(triangle[0], triangle[1]), triangle[2]);
    const glm::dvec2 high = glm::max(glm::max(triangle[0], triangle[1]), triangle[2]);
    const glm::dvec2 gap = glm::max(low - rectangle.Center, rectangle.Center - high);
    if (gap.x > half.x || gap.y > half.y)
    {
      return Overlaps::Disjoint;
    }
    bool covers = true;
    for (int i = 0; i < 3; ++i)
    {
      const glm::dvec2 edge = triangle[(i + 1) % 3] - triangle[i];
      const glm::dvec2 offset = rectangle.Center - triangle[i];
      const double middle = edge.x * offset.y - edge.y * offset.x;
      const double range = std::abs(edge.y) * half.x + std::abs(edge.x) * half.y;
      if (middle + range < 0.0)
      {
        return Overlaps::Disjoint;
      }
      covers = covers && middle > range;
    }
    return covers ? Overlaps::Covering : Overlaps::Partial;
  }

  /// Makes the cells of a rectangle. `candidates` are the triangles that may overlap it. Returns
  /// false if a limit is exceeded.
  bool Split(const Rectangle& rectangle, const std::vector<std::uint32_t>& candidates, int level)
  {
    std::vector<std::uint32_t> listed;
    for (const std::uint32_t triangle : candidates)
    {
      ++this->Tests;
      const Overlaps overlap = this->Compare(this->Projected[triangle], rectangle);
      if (overlap != Overlaps::Disjoint)
      {
        listed.push_back(triangle);
      }
      if (overlap == Overlaps::Covering)
      {
        break;
      }
    }
    if (this->Tests > MaximumTests * this->Projected.size())
    {
      return false;
    }
    if (listed.size() <= LeafSize || level == MaximumLevel)
    {
      return listed.empty() || this->AddCell(rectangle, listed);
    }
    const glm::dvec2 half = 0.5 * rectangle.Half;
    for (int i = 0; i < 4; ++i)
    {
      const glm::dvec2 side(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0);
      if (!this->Split({ rectangle.Center + side * half, half }, listed, level + 1))
      {
        return false;
      }
    }
    return true;
  }

  bool AddCell(const Rectangle& rectangle, const std::vector<std::uint32_t>& listed)
  {
    const int i = this->GetAxis(0);
    const int j = this->GetAxis(1);
    const glm::dvec3 normal = this->SurfacePlane.Normal;
    glm::dvec3 center(0.0);
    center[i] = rectangle.Center.x;
    center[j] = rectangle.Center.y;
    center[this->Up] = (this->SurfacePlane.Offset - glm::dot(normal, center)) / normal[this->Up];
    glm::dvec3 half(0.0);
    half[i] = rectangle.Half.x;
    half[j] = rectangle.Half.y;
    half[this->Up] = glm::dot(glm::abs(normal), half) / std::abs(normal[this->Up]);
    half += 2.0 * this->Slack;
    AxisAlignedBox box;
    box.Add(glm::vec3(center - half));
    box.Add(glm::vec3(center + half));
    PlanarCells& cells = *this->Cells;
    cells.Boxes.push_back(box);
    cells.Triangles.insert(cells.Triangles.end(), listed.begin(), listed.end());
    cells.Firsts.push_back(static_cast<std::uint32_t>(cells.Triangles.size()));
    return cells.Triangles.size() <= MaximumListed * this->Projected.size();
  }

  const Plane SurfacePlane;
  const double Slack;
  const bool IsLastInFront;
  int Up = 2; ///< axis of the projection
  std::vector<Corners> Projected;
  std::size_t Tests = 0;
  std::shared_ptr<PlanarCells> Cells;
};

bool IsPlanar(const Surface& surface)
{
  const Plane plane = FindPlane(surface);
  return plane.Normal != glm::dvec3(0.0) && IsInPlane(surface, plane, ComputeSlack(surface));
}

std::shared_ptr<const PlanarCells> PlanarCells::MakeIfUseful(
  const Surface& surface, const BoxOverlap& overlap)
{
  // Copies are removed at less cost.
  if (!(overlap.Number > MinimumDepth * overlap.Thinness) || surface.IsLineOrPoint ||
    !surface.Frontfaces || !surface.Backfaces || !RemoveCopies(surface).empty())
  {
    return nullptr;
  }
  const Plane plane = FindPlane(surface);
  const double slack = ComputeSlack(surface);
  return plane.Normal != glm::dvec3(0.0) && IsInPlane(surface, plane, slack)
    ? PlanarCellBuilder(surface, plane, slack).Build()
    : nullptr;
}

}
