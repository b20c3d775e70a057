// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleClusters.h"

#include "Surface.h"
#include "Vectors.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace penumbra
{
namespace
{

/// Maximum number of triangles of a cluster. Culling a cluster must cost less than rendering it.
constexpr std::size_t ClusterSize = 128;

/// Largest triangle id that a float represents exactly with all smaller ones.
constexpr std::size_t MaximumTriangles = (std::size_t(1) << 24) - 1;

glm::vec3 GetVertex(
  const std::vector<Surface>& surfaces, const TriangleClusters::Triangle& triangle, int vertex)
{
  const Surface& surface = surfaces[triangle.Surface];
  return surface.GetPoints(triangle.Triangle)[static_cast<std::size_t>(vertex)];
}

/// Morton code of a point of the unit cube; nearby points mostly have nearby codes.
std::uint64_t ComputeMortonCode(glm::vec3 point)
{
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const float scaled = glm::clamp(point[axis], 0.f, 1.f) * 2097151.f;
    key |= SpreadBits(static_cast<std::uint64_t>(scaled)) << axis;
  }
  return key;
}

void CheckCount(std::size_t triangles)
{
  if (triangles > MaximumTriangles)
  {
    throw std::runtime_error("Gathering by cube maps supports at most " +
      std::to_string(MaximumTriangles) + " triangles: simplify the scene or gather by rays.");
  }
}

struct SortedTriangle
{
  int Sides;
  std::uint64_t Key;
  TriangleClusters::Triangle Triangle;
};

}

TriangleClusters::TriangleClusters(const std::vector<Surface>& surfaces)
{
  glm::vec3 low(std::numeric_limits<float>::max());
  glm::vec3 high(-low);
  std::vector<SortedTriangle> sorted;
  for (std::uint32_t s = 0; s < surfaces.size(); ++s)
  {
    const Surface& surface = surfaces[s];
    if (surface.IsLineOrPoint || (!surface.Frontfaces && !surface.Backfaces))
    {
      continue;
    }
    if (surface.IsRound())
    {
      throw std::runtime_error(
        "Gathering by cube maps does not support spheres and tubes: gather by rays.");
    }
    CheckCount(sorted.size() + surface.GetNumberOfPrimitives());
    const Sides sides = !surface.Backfaces ? FrontOnly : !surface.Frontfaces ? BackOnly : Both;
    for (std::uint32_t t = 0; t < surface.GetNumberOfPrimitives(); ++t)
    {
      sorted.push_back({ sides, 0, { s, t } });
      for (int c = 0; c < 3; ++c)
      {
        const glm::vec3 vertex = GetVertex(surfaces, sorted.back().Triangle, c);
        low = glm::min(low, vertex);
        high = glm::max(high, vertex);
      }
    }
  }
  const glm::vec3 size = glm::max(high - low, glm::vec3(1e-30f));
  for (SortedTriangle& item : sorted)
  {
    const glm::vec3 centroid =
      (GetVertex(surfaces, item.Triangle, 0) + GetVertex(surfaces, item.Triangle, 1) +
        GetVertex(surfaces, item.Triangle, 2)) /
      3.f;
    item.Key = ComputeMortonCode((centroid - low) / size);
  }
  std::stable_sort(
    sorted.begin(), sorted.end(), [](const SortedTriangle& a, const SortedTriangle& b) {
      return a.Sides != b.Sides ? a.Sides < b.Sides : a.Key < b.Key;
    });
  for (std::size_t first = 0; first < sorted.size();)
  {
    std::size_t end = first;
    low = glm::vec3(std::numeric_limits<float>::max());
    high = -low;
    for (; end < sorted.size() && end - first < ClusterSize &&
         sorted[end].Sides == sorted[first].Sides;
         ++end)
    {
      this->Triangles.push_back(sorted[end].Triangle);
      for (int c = 0; c < 3; ++c)
      {
        const glm::vec3 vertex = GetVertex(surfaces, sorted[end].Triangle, c);
        low = glm::min(low, vertex);
        high = glm::max(high, vertex);
      }
    }
    this->Clusters[sorted[first].Sides].push_back({ .5f * (low + high), .5f * (high - low),
      static_cast<int>(first), static_cast<int>(end - first) });
    first = end;
  }
}

std::vector<IdVertex> TriangleClusters::CreateVertices(const std::vector<Surface>& surfaces) const
{
  std::vector<IdVertex> vertices;
  vertices.reserve(3 * this->Triangles.size());
  for (std::size_t i = 0; i < this->Triangles.size(); ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      vertices.push_back({ GetVertex(surfaces, this->Triangles[i], c), static_cast<float>(i + 1) });
    }
  }
  return vertices;
}

long long TriangleClusters::CullToFrustum(
  const Frustum& view, Sides sides, DrawRanges& ranges) const
{
  ranges.First.clear();
  ranges.Count.clear();
  long long count = 0;
  for (const Cluster& cluster : this->Clusters[sides])
  {
    const glm::vec3 offset = cluster.Center - view.Eye;
    const glm::vec3 distance = glm::max(glm::abs(offset) - cluster.HalfSize, glm::vec3(0.f));
    bool visible = glm::length(distance) <= view.Far;
    for (std::size_t i = 0; visible && i < view.Inwards.size(); ++i)
    {
      const glm::vec3& inwards = view.Inwards[i];
      visible = glm::dot(inwards, offset) + glm::dot(glm::abs(inwards), cluster.HalfSize) >= 0.f;
    }
    if (!visible)
    {
      continue;
    }
    count += cluster.Count;
    const int first = 3 * cluster.First;
    if (!ranges.First.empty() && ranges.First.back() + ranges.Count.back() == first)
    {
      ranges.Count.back() += 3 * cluster.Count;
    }
    else
    {
      ranges.First.push_back(first);
      ranges.Count.push_back(3 * cluster.Count);
    }
  }
  return count;
}

}
