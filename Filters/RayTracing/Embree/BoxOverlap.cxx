// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BoxOverlap.h"

#include "AxisAlignedBox.h"

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

double ComputeArea(const AxisAlignedBox& box)
{
  const glm::dvec3 size = glm::dvec3(box.High) - glm::dvec3(box.Low);
  return 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
}

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

/// Returns the triangles among every `stride`-th one that are copies of earlier ones.
std::vector<std::uint32_t> FindCopies(const Surface& surface, std::size_t stride)
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
      copies.push_back(std::get<1>(keys[i]));
    }
  }
  return copies;
}

}

BoxOverlap::BoxOverlap(const Surface& surface)
{
  AxisAlignedBox bounds;
  double boxes = 0.0;
  double triangles = 0.0;
  for (const glm::uvec3& t : surface.Triangles)
  {
    AxisAlignedBox box;
    for (int i = 0; i < 3; ++i)
    {
      box.Add(surface.Positions[t[i]]);
    }
    const glm::vec3 a = surface.Positions[t.x];
    boxes += ComputeArea(box);
    triangles += glm::length(glm::cross(surface.Positions[t.y] - a, surface.Positions[t.z] - a));
    bounds.Add(box);
  }
  const double area = ComputeArea(bounds);
  this->Number = area > 0.0 ? boxes / area : 0.0;
  this->Thinness = boxes > 0.0 ? boxes / std::max(triangles, 1e-300) : 0.0;
}

std::vector<glm::uvec3> RemoveCopies(const Surface& surface)
{
  const std::size_t stride = surface.Triangles.size() / MaximumTrianglesTried + 1;
  if (FindCopies(surface, stride).empty())
  {
    return {};
  }
  std::vector<glm::uvec3> triangles = surface.Triangles;
  for (const std::uint32_t copy : FindCopies(surface, 1))
  {
    triangles[copy] = glm::uvec3(std::numeric_limits<std::uint32_t>::max());
  }
  return triangles;
}

}
