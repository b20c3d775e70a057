// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// BVH of oriented boxes for surfaces of slivers, such as large fans. The axis-aligned boxes of n
// slivers side by side overlap, so that a ray through Embree's BVH tests a number of them that is
// proportional to n. Oriented boxes around adjacent slivers are thin [OBBTree]. Slabs parallel to the edges
// of one sliver cut the ends of the boxes.
//
// [OBBTree] S. Gottschalk, M. C. Lin, D. Manocha: OBBTree: A Hierarchical Structure for Rapid
// Interference Detection, SIGGRAPH 1996.
#ifndef penumbra_SliverTree_h
#define penumbra_SliverTree_h

#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace penumbra
{

struct Surface;

struct BoxOverlap;

class VTKPENUMBRAFILTERSRAYTRACING_EXPORT SliverTree
{
public:
  /// Builds the tree of every `stride`-th triangle of `surface`, which must outlive it.
  explicit SliverTree(const Surface& surface, std::size_t stride = 1);

  /// Returns the tree if the surface is better traced with it than with axis-aligned boxes,
  /// otherwise null. `overlap` is that of the surface.
  static std::shared_ptr<const SliverTree> MakeIfUseful(
    const Surface& surface, const BoxOverlap& overlap);

  /// Calls visit(triangle) for the triangles whose leaves the ray crosses at distances between
  /// `nearest` and `farthest`, nearer leaves first. `visit` may reduce `farthest`.
  template <typename Visit>
  void VisitRay(const glm::dvec3& origin, const glm::dvec3& direction, double nearest,
    const double& farthest, Visit visit) const;

  /// Calls visit(triangle) for the triangles whose leaves are within `radius` of `point`.
  template <typename Visit>
  void VisitNear(const glm::dvec3& point, double radius, Visit visit) const;

  const Surface& GetSurface() const { return this->Mesh; }

private:
  /// An oriented box, the points p with |dot(Axes[i], p - Center)| <= 1, cut by slabs, the points
  /// with |dot(Slabs[i], p - Center) - Shifts[i]| <= 1. The slabs are perpendicular to a
  /// triangle and parallel to its edges.
  struct Node
  {
    static constexpr int NumberOfSlabs = 3;

    glm::vec3 Center{ 0.f };
    glm::vec3 Axes[3];
    glm::vec3 Slabs[NumberOfSlabs];
    float Shifts[NumberOfSlabs];
    std::uint32_t First = 0; ///< of the triangles of a leaf, or the second child of another node
    std::uint32_t Count = 0; ///< number of triangles; 0: not a leaf, whose first child is next
  };

  static constexpr std::uint32_t LeafSize = 4;
  static constexpr int MaximumDepth = 64;

  void Build(std::uint32_t first, std::uint32_t last);
  void Fit(Node& node, std::uint32_t first, std::uint32_t last) const;
  template <typename Function>
  void ForEachCorner(std::uint32_t first, std::uint32_t last, Function function) const;
  void FitSlabs(
    Node& node, std::uint32_t first, std::uint32_t last, const glm::dvec3& fallback) const;
  std::uint32_t Split(std::uint32_t first, std::uint32_t last);
  /// Returns the ratio of the areas of the axis-aligned and the oriented boxes of the leaves.
  double ComputeGain() const;

  /// Returns the distance at which the ray enters the box, at least `nearest`, which is not
  /// negative; -1 if it does not cross the box.
  static double Enter(const Node& node, const glm::dvec3& origin, const glm::dvec3& direction,
    double nearest, double farthest)
  {
    const glm::dvec3 offset = origin - glm::dvec3(node.Center);
    double enter = nearest;
    double leave = farthest;
    const auto clip = [&](const glm::vec3& axis, double shift) {
      const double position = glm::dot(glm::dvec3(axis), offset) - shift;
      const double speed = glm::dot(glm::dvec3(axis), direction);
      if (speed == 0.0)
      {
        leave = std::abs(position) <= 1.0 ? leave : -1.0;
        return;
      }
      const double inverse = 1.0 / speed;
      const double middle = -position * inverse;
      const double half = std::abs(inverse);
      enter = enter < middle - half ? middle - half : enter;
      leave = leave > middle + half ? middle + half : leave;
    };
    for (const glm::vec3& axis : node.Axes)
    {
      clip(axis, 0.0);
    }
    for (int i = 0; i < Node::NumberOfSlabs && enter <= leave; ++i)
    {
      clip(node.Slabs[i], node.Shifts[i]);
    }
    return enter <= leave ? enter : -1.0;
  }

  const Surface& Mesh;
  double Slack = 0.0; ///< added to half the sizes of boxes
  std::vector<Node> Nodes;
  std::vector<std::uint32_t> Order; ///< triangles, grouped by leaves
};

template <typename Visit>
void SliverTree::VisitRay(const glm::dvec3& origin, const glm::dvec3& direction, double nearest,
  const double& farthest, Visit visit) const
{
  std::pair<std::uint32_t, double> stack[MaximumDepth];
  int size = 0;
  const auto push = [&](std::uint32_t node, double enter) {
    if (enter >= 0.0)
    {
      stack[size++] = { node, enter };
    }
  };
  const auto enter = [&](std::uint32_t node) {
    return Enter(this->Nodes[node], origin, direction, nearest, farthest);
  };
  if (!this->Nodes.empty())
  {
    push(0, enter(0));
  }
  while (size > 0)
  {
    const auto [index, distance] = stack[--size];
    if (distance > farthest)
    {
      continue;
    }
    const Node& node = this->Nodes[index];
    for (std::uint32_t i = 0; i < node.Count; ++i)
    {
      visit(this->Order[node.First + i]);
    }
    if (node.Count == 0)
    {
      const double first = enter(index + 1);
      const double second = enter(node.First);
      push(first <= second ? node.First : index + 1, first <= second ? second : first);
      push(first <= second ? index + 1 : node.First, first <= second ? first : second);
    }
  }
}

template <typename Visit>
void SliverTree::VisitNear(const glm::dvec3& point, double radius, Visit visit) const
{
  std::uint32_t stack[MaximumDepth];
  int size = 0;
  if (!this->Nodes.empty())
  {
    stack[size++] = 0;
  }
  while (size > 0)
  {
    const std::uint32_t index = stack[--size];
    const Node& node = this->Nodes[index];
    bool isNear = true;
    for (const glm::dvec3 axis : node.Axes)
    {
      isNear = isNear &&
        std::abs(glm::dot(axis, point - glm::dvec3(node.Center))) <=
          1.0 + radius * glm::length(axis);
    }
    for (std::uint32_t i = 0; isNear && i < node.Count; ++i)
    {
      visit(this->Order[node.First + i]);
    }
    if (isNear && node.Count == 0)
    {
      stack[size++] = node.First;
      stack[size++] = index + 1;
    }
  }
}

}
#endif
