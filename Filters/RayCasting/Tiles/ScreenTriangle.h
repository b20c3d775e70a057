// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The projection of a triangle to the image: its corners, values that are linear in the image, and the
// cells of a grid that it overlaps.
#ifndef penumbra_ScreenTriangle_h
#define penumbra_ScreenTriangle_h

#include "Camera.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

/// The part of a triangle behind the near plane, in image coordinates (pixels).
struct ScreenTriangle
{
  std::array<glm::dvec2, 4> Points;
  /// Values at the points that are linear in the image: 1 / depth in perspective projection, -depth
  /// in parallel projection. The nearer of two points has the larger value.
  std::array<double, 4> Keys;
  int Count = 0;          ///< 0: nothing is visible
  bool IsClipped = false; ///< the near plane intersects the triangle

  ScreenTriangle(const std::array<glm::vec3, 3>& points, const Camera& camera);

  /// Returns true if the near plane does not cut the triangle, which then has three points.
  bool IsWhole() const { return this->Count == 3 && !this->IsClipped; }

  /// Makes the coordinates relative to `origin`.
  void MoveOrigin(glm::dvec2 origin)
  {
    for (int i = 0; i < this->Count; ++i)
    {
      this->Points[i] -= origin;
    }
  }

  /// Returns twice the signed area of a whole triangle.
  double ComputeDoubleArea() const
  {
    const glm::dvec2 ab = this->Points[1] - this->Points[0];
    const glm::dvec2 ac = this->Points[2] - this->Points[0];
    return ab.x * ac.y - ab.y * ac.x;
  }

  /// Returns the value, linear relative to `origin`, that is a, b, c at the points of a whole triangle,
  /// whose area is not 0.
  template <typename Scalar>
  LinearValue<Scalar> MakePlane(
    const Scalar& a, const Scalar& b, const Scalar& c, glm::dvec2 origin = glm::dvec2(0.0)) const
  {
    const glm::dvec2 ab = this->Points[1] - this->Points[0];
    const glm::dvec2 ac = this->Points[2] - this->Points[0];
    const double area = ab.x * ac.y - ab.y * ac.x;
    const Scalar u = b - a;
    const Scalar v = c - a;
    LinearValue<Scalar> plane;
    plane.SlopeX = (u * ac.y - v * ab.y) / area;
    plane.SlopeY = (v * ab.x - u * ac.x) / area;
    const glm::dvec2 p = this->Points[0] - origin;
    plane.Value = a - plane.SlopeX * p.x - plane.SlopeY * p.y;
    return plane;
  }

  /// Returns the plane of Keys.
  LinearValue<double> MakeKeyPlane() const
  {
    return this->MakePlane(this->Keys[0], this->Keys[1], this->Keys[2]);
  }
};

inline ScreenTriangle::ScreenTriangle(const std::array<glm::vec3, 3>& points, const Camera& camera)
{
  const double near = std::max(camera.Near, camera.Parallel ? -1e300 : 1e-9);
  const auto add = [&](glm::dvec3 x, double depth) {
    this->Points[this->Count] = camera.Project(x);
    this->Keys[this->Count++] = camera.Parallel ? -depth : 1.0 / depth;
  };
  double depths[3];
  for (int i = 0; i < 3; ++i)
  {
    depths[i] = camera.Depth(glm::dvec3(points[i]));
  }
  for (int i = 0; i < 3; ++i)
  {
    const int j = (i + 1) % 3;
    const glm::dvec3 a(points[i]);
    if (depths[i] >= near)
    {
      add(a, depths[i]);
    }
    if ((depths[i] < near) != (depths[j] < near))
    {
      this->IsClipped = true;
      add(a + (glm::dvec3(points[j]) - a) * ((near - depths[i]) / (depths[j] - depths[i])), near);
    }
  }
}

/// Calls visit(cell) for the cells of a grid that a convex polygon overlaps, enlarged by `margin` pixels.
/// The grid has `cells.x` by `cells.y` squares of side `size` and the lower left corner `origin`.
template <typename Visit>
void VisitCells(const ScreenTriangle& triangle, double margin, glm::dvec2 origin, double size,
  glm::ivec2 cells, const Visit& visit)
{
  if (triangle.Count == 0)
  {
    return;
  }
  margin /= size;
  std::array<glm::dvec2, 4> points;
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high = -low;
  for (int i = 0; i < triangle.Count; ++i)
  {
    points[i] = (triangle.Points[i] - origin) / size;
    low = glm::min(low, points[i]);
    high = glm::max(high, points[i]);
  }
  // The comparison is false for NaN.
  if (!(low.x - margin < cells.x && low.y - margin < cells.y && high.x + margin >= 0.0 &&
        high.y + margin >= 0.0))
  {
    return;
  }
  const glm::dvec2 from = glm::floor(low - margin);
  const glm::dvec2 to = glm::floor(high + margin);
  const glm::ivec2 first(glm::max(from, 0.0));
  const glm::ivec2 last(glm::min(to, glm::dvec2(cells) - 1.0));
  for (int row = first.y; row <= last.y; ++row)
  {
    int begin = first.x;
    int end = last.x;
    if (from.x < to.x && from.y < to.y) // not only in these cells, so that the grid does not matter
    {
      // The part of the polygon between the lower and the upper side of the row.
      const double bottom = row - margin;
      const double top = row + 1 + margin;
      double left = std::numeric_limits<double>::infinity();
      double right = -left;
      for (int i = 0; i < triangle.Count; ++i)
      {
        const glm::dvec2 a = points[i];
        const glm::dvec2 d = points[i + 1 < triangle.Count ? i + 1 : 0] - a;
        double enter = 0.0;
        double leave = 1.0;
        if (d.y != 0.0)
        {
          const double t0 = (bottom - a.y) / d.y;
          const double t1 = (top - a.y) / d.y;
          enter = std::max(enter, std::min(t0, t1));
          leave = std::min(leave, std::max(t0, t1));
        }
        else if (a.y < bottom || a.y > top)
        {
          continue;
        }
        if (enter <= leave)
        {
          const double x0 = a.x + enter * d.x;
          const double x1 = a.x + leave * d.x;
          left = std::min({ left, x0, x1 });
          right = std::max({ right, x0, x1 });
        }
      }
      if (!(left <= right))
      {
        continue;
      }
      const double width = cells.x;
      begin = std::max(begin, static_cast<int>(std::floor(std::clamp(left - margin, 0.0, width))));
      end =
        std::min(end, static_cast<int>(std::floor(std::clamp(right + margin, -1.0, width - 0.5))));
    }
    for (int column = begin; column <= end; ++column)
    {
      visit(row * cells.x + column);
    }
  }
}

}
#endif
