// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BoxOverlap.h"

#include "AxisAlignedBox.h"
#include "Execution/ParallelFor.h"
#include "Surface.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>

namespace penumbra
{

namespace
{

/// Number of triangles, approximately, that are first searched for copies.
constexpr std::size_t MaximumTrianglesTried = 8192;

/// The positions of the corners, the smallest first, and the index of a triangle.
using Key = std::tuple<std::array<std::array<float, 3>, 3>, std::uint32_t>;

Key MakeKey(const Surface& surface, std::uint32_t triangle)
{
  std::array<std::array<float, 3>, 3> corners;
  for (int i = 0; i < 3; ++i)
  {
    const glm::vec3 p = surface.Positions[surface.Triangles[triangle][i]];
    corners[i] = { p.x, p.y, p.z };
  }
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return { corners, triangle };
}

/// Returns the triangles among every `stride`-th one that are copies of earlier ones, or of later ones.
std::vector<std::uint32_t> FindCopies(const Surface& surface, std::size_t stride, bool ofLaterOnes)
{
  std::vector<Key> keys;
  keys.reserve(surface.Triangles.size() / stride + 1);
  for (std::size_t i = 0; i < surface.Triangles.size(); i += stride)
  {
    keys.push_back(MakeKey(surface, static_cast<std::uint32_t>(i)));
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> copies;
  for (std::size_t i = 1; i < keys.size(); ++i)
  {
    if (std::get<0>(keys[i]) == std::get<0>(keys[i - 1]))
    {
      copies.push_back(std::get<1>(keys[ofLaterOnes ? i - 1 : i]));
    }
  }
  return copies;
}

}

BoxOverlap::BoxOverlap(const Surface& surface)
{
  struct Sums
  {
    AxisAlignedBox Bounds;
    double Boxes = 0.0;
    double Triangles = 0.0;
  };
  const std::vector<std::size_t> boundaries = SplitIntoParts(surface.Triangles.size(), ArrayGrain);
  std::vector<Sums> parts(boundaries.size() - 1);
  ParallelFor<std::size_t>(0, parts.size(), 1, [&](std::size_t part) {
    Sums sums;
    for (std::size_t k = boundaries[part]; k < boundaries[part + 1]; ++k)
    {
      const glm::uvec3 t = surface.Triangles[k];
      AxisAlignedBox box;
      for (int i = 0; i < 3; ++i)
      {
        box.Add(surface.Positions[t[i]]);
      }
      const glm::vec3 a = surface.Positions[t.x];
      sums.Boxes += box.ComputeArea();
      sums.Triangles +=
        glm::length(glm::cross(surface.Positions[t.y] - a, surface.Positions[t.z] - a));
      sums.Bounds.Add(box);
    }
    parts[part] = sums;
  });
  Sums total;
  for (const Sums& part : parts)
  {
    total.Boxes += part.Boxes;
    total.Triangles += part.Triangles;
    total.Bounds.Add(part.Bounds);
  }
  const double area = total.Bounds.ComputeArea();
  this->Number = area > 0.0 ? total.Boxes / area : 0.0;
  this->Thinness = total.Boxes > 0.0 ? total.Boxes / std::max(total.Triangles, 1e-300) : 0.0;
}

std::vector<glm::uvec3> RemoveCopies(const Surface& surface, bool isLastInFront)
{
  const std::size_t stride = surface.Triangles.size() / MaximumTrianglesTried + 1;
  if (FindCopies(surface, stride, isLastInFront).empty())
  {
    return {};
  }
  std::vector<glm::uvec3> triangles = surface.Triangles;
  for (const std::uint32_t copy : FindCopies(surface, 1, isLastInFront))
  {
    triangles[copy] = glm::uvec3(std::numeric_limits<std::uint32_t>::max());
  }
  return triangles;
}

}
