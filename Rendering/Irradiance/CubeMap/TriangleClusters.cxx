// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleClusters.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace penumbra
{
namespace
{

/// Triangles of a bundle: leaving one out has to cost less than drawing it.
constexpr std::size_t BundleSize = 128;

/// Numbers that single precision holds.
constexpr std::size_t MostTriangles = (std::size_t(1) << 24) - 1;

glm::vec3 CornerOf(const Scene& scene, const TriangleClusters::Triangle& which, int corner)
{
  const Surface& surface = scene.Surfaces[which.Surface];
  return surface.Positions[surface.Triangles[which.Triangle][corner]];
}

/// Every third bit.
std::uint64_t Spread(std::uint64_t x)
{
  x = (x | x << 32) & 0x001f00000000ffffu;
  x = (x | x << 16) & 0x001f0000ff0000ffu;
  x = (x | x << 8) & 0x100f00f00f00f00fu;
  x = (x | x << 4) & 0x10c30c30c30c30c3u;
  return (x | x << 2) & 0x1249249249249249u;
}

/// Places that are near each other mostly have keys that are (Morton's order). `at`: 0 to 1.
std::uint64_t KeyOf(glm::vec3 at)
{
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const float scaled = glm::clamp(at[axis], 0.f, 1.f) * 2097151.f;
    key |= Spread(static_cast<std::uint64_t>(scaled)) << axis;
  }
  return key;
}

struct Sorted
{
  int Sides;
  std::uint64_t Key;
  TriangleClusters::Triangle Which;
};

}

TriangleClusters::TriangleClusters(const Scene& scene)
{
  glm::vec3 low(std::numeric_limits<float>::max());
  glm::vec3 high(-low);
  std::vector<Sorted> sorted;
  for (std::uint32_t s = 0; s < scene.Surfaces.size(); ++s)
  {
    const Surface& surface = scene.Surfaces[s];
    if (surface.IsLineOrPoint || (!surface.Frontfaces && !surface.Backfaces))
    {
      continue;
    }
    const Sides sides = !surface.Backfaces ? FrontOnly : !surface.Frontfaces ? BackOnly : Both;
    for (std::uint32_t t = 0; t < surface.Triangles.size(); ++t)
    {
      sorted.push_back({ sides, 0, { s, t } });
      for (int c = 0; c < 3; ++c)
      {
        const glm::vec3 corner = CornerOf(scene, sorted.back().Which, c);
        low = glm::min(low, corner);
        high = glm::max(high, corner);
      }
    }
  }
  if (sorted.size() > MostTriangles)
  {
    throw std::runtime_error("A cube map cannot number more than " + std::to_string(MostTriangles) +
      " triangles: gather by rays.");
  }
  const glm::vec3 size = glm::max(high - low, glm::vec3(1e-30f));
  for (Sorted& one : sorted)
  {
    const glm::vec3 middle = (CornerOf(scene, one.Which, 0) + CornerOf(scene, one.Which, 1) +
                               CornerOf(scene, one.Which, 2)) /
      3.f;
    one.Key = KeyOf((middle - low) / size);
  }
  std::stable_sort(sorted.begin(), sorted.end(), [](const Sorted& a, const Sorted& b) {
    return a.Sides != b.Sides ? a.Sides < b.Sides : a.Key < b.Key;
  });
  for (std::size_t first = 0; first < sorted.size();)
  {
    std::size_t end = first;
    low = glm::vec3(std::numeric_limits<float>::max());
    high = -low;
    for (; end < sorted.size() && end - first < BundleSize &&
         sorted[end].Sides == sorted[first].Sides;
         ++end)
    {
      this->Triangles.push_back(sorted[end].Which);
      for (int c = 0; c < 3; ++c)
      {
        const glm::vec3 corner = CornerOf(scene, sorted[end].Which, c);
        low = glm::min(low, corner);
        high = glm::max(high, corner);
      }
    }
    this->Bundles[sorted[first].Sides].push_back({ .5f * (low + high), .5f * (high - low),
      static_cast<int>(first), static_cast<int>(end - first) });
    first = end;
  }
}

std::vector<IdVertex> TriangleClusters::MakeCorners(const Scene& scene) const
{
  std::vector<IdVertex> corners;
  corners.reserve(3 * this->Triangles.size());
  for (std::size_t i = 0; i < this->Triangles.size(); ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      corners.push_back({ CornerOf(scene, this->Triangles[i], c), static_cast<float>(i + 1) });
    }
  }
  return corners;
}

long long TriangleClusters::CullToFrustum(const Frustum& view, Sides sides, DrawRanges& runs) const
{
  runs.First.clear();
  runs.Count.clear();
  long long found = 0;
  for (const Bundle& bundle : this->Bundles[sides])
  {
    const glm::vec3 to = bundle.Middle - view.Eye;
    const glm::vec3 apart = glm::max(glm::abs(to) - bundle.Half, glm::vec3(0.f));
    bool in = glm::length(apart) <= view.Reach;
    for (std::size_t i = 0; in && i < view.Inwards.size(); ++i)
    {
      const glm::vec3& inwards = view.Inwards[i];
      in = glm::dot(inwards, to) + glm::dot(glm::abs(inwards), bundle.Half) >= 0.f;
    }
    if (!in)
    {
      continue;
    }
    found += bundle.Count;
    const int first = 3 * bundle.First;
    if (!runs.First.empty() && runs.First.back() + runs.Count.back() == first)
    {
      runs.Count.back() += 3 * bundle.Count;
    }
    else
    {
      runs.First.push_back(first);
      runs.Count.push_back(3 * bundle.Count);
    }
  }
  return found;
}

}
