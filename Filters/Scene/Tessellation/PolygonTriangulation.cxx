// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PolygonTriangulation.h"

namespace penumbra
{
namespace
{

using Ring = std::vector<unsigned int>;

Ring DistinctCorners(const std::vector<glm::dvec3>& corners)
{
  Ring ring;
  for (unsigned int i = 0; i < corners.size(); ++i)
  {
    if (ring.empty() || corners[i] != corners[ring.back()])
    {
      ring.push_back(i);
    }
  }
  while (ring.size() > 1 && corners[ring.back()] == corners[ring.front()])
  {
    ring.pop_back();
  }
  return ring;
}

/// Newell's normal, relative to the first corner so that far-away polygons lose nothing.
glm::dvec3 Normal(const std::vector<glm::dvec3>& corners, const Ring& ring)
{
  glm::dvec3 normal(0.0);
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
  {
    normal +=
      glm::cross(corners[ring[i]] - corners[ring[0]], corners[ring[i + 1]] - corners[ring[0]]);
  }
  return normal;
}

/// Can the corner at `i` of the ring be cut off without crossing the rest?
bool IsEar(
  const std::vector<glm::dvec3>& corners, const Ring& ring, std::size_t i, glm::dvec3 normal)
{
  const std::size_t size = ring.size();
  const glm::dvec3 a = corners[ring[(i + size - 1) % size]];
  const glm::dvec3 b = corners[ring[i]];
  const glm::dvec3 c = corners[ring[(i + 1) % size]];
  const auto side = [&](glm::dvec3 p, glm::dvec3 q, glm::dvec3 x) {
    return glm::dot(glm::cross(q - p, x - p), normal);
  };
  if (side(a, b, c) <= 0.0)
  {
    return false;
  }
  for (std::size_t k = 2; k + 1 < size; ++k)
  {
    const glm::dvec3 x = corners[ring[(i + k) % size]];
    if (side(a, b, x) > 0.0 && side(b, c, x) > 0.0 && side(c, a, x) > 0.0)
    {
      return false;
    }
  }
  return true;
}

}

void TriangulatePolygon(const std::vector<glm::dvec3>& corners, std::vector<glm::uvec3>& triangles)
{
  triangles.clear();
  Ring ring = DistinctCorners(corners);
  if (ring.size() < 3)
  {
    return;
  }
  const glm::dvec3 normal = Normal(corners, ring);
  std::size_t i = 1;
  std::size_t looked = 0;
  while (ring.size() > 3)
  {
    i %= ring.size();
    if (looked < ring.size() && !IsEar(corners, ring, i, normal))
    {
      ++i;
      ++looked;
      continue;
    }
    // An ear, or none is left (the outline crosses itself): cut anyway.
    const std::size_t size = ring.size();
    triangles.emplace_back(ring[(i + size - 1) % size], ring[i], ring[(i + 1) % size]);
    ring.erase(ring.begin() + static_cast<Ring::difference_type>(i));
    looked = 0;
  }
  i %= 3;
  triangles.emplace_back(ring[(i + 2) % 3], ring[i], ring[(i + 1) % 3]);
}

}
