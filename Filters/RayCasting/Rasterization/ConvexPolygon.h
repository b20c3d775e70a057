// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef penumbra_ConvexPolygon_h
#define penumbra_ConvexPolygon_h

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

namespace penumbra
{

/// A convex polygon in coordinates of the pixel. Each line that cuts it adds at most a point, two whatever rounding
/// does. Points above the capacity are left out.
template <typename Real, std::size_t Capacity>
struct ConvexPolygon
{
  using Point = glm::vec<2, Real>;

  void Add(Point p)
  {
    if (Count < static_cast<int>(Capacity))
    {
      Points[static_cast<std::size_t>(Count++)] = p;
    }
  }

  std::array<Point, Capacity> Points;
  int Count = 0;
};

/// Divides a polygon into the part where the linear function `evaluate` of a point is negative, and the rest.
template <typename Real, std::size_t Capacity, typename Evaluate>
void Split(const ConvexPolygon<Real, Capacity>& polygon, const Evaluate& evaluate,
  ConvexPolygon<Real, Capacity>& negative, ConvexPolygon<Real, Capacity>& rest)
{
  negative.Count = rest.Count = 0;
  for (int i = 0; i < polygon.Count; ++i)
  {
    const auto p = polygon.Points[i];
    const auto q = polygon.Points[i + 1 < polygon.Count ? i + 1 : 0];
    const auto a = evaluate(p);
    const auto b = evaluate(q);
    (a < 0 ? negative : rest).Add(p);
    if ((a < 0) != (b < 0))
    {
      const auto crossing = p + static_cast<Real>(a / (a - b)) * (q - p);
      negative.Add(crossing);
      rest.Add(crossing);
    }
  }
}

}
#endif
