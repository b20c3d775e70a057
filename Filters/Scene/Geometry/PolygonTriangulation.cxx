// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PolygonTriangulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace penumbra
{
namespace
{

using Ring = std::vector<unsigned int>;

/// Minimum number of corners for which EarClipper is used instead of the quadratic search, which
/// has less overhead for small polygons.
constexpr std::size_t MinimumCornersForTree = 64;

/// Returns twice the signed area of triangle (p, q, x) as seen along `normal`, times the length of
/// `normal`.
double ComputeOrientation(
  const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& x, const glm::dvec3& normal)
{
  return glm::dot(glm::cross(q - p, x - p), normal);
}

Ring CollectDistinctCorners(const std::vector<glm::dvec3>& corners)
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

/// Computes Newell's normal relative to the first corner, which keeps the precision of polygons far
/// from the origin.
glm::dvec3 ComputeNormal(const std::vector<glm::dvec3>& corners, const Ring& ring)
{
  glm::dvec3 normal(0.0);
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
  {
    normal +=
      glm::cross(corners[ring[i]] - corners[ring[0]], corners[ring[i + 1]] - corners[ring[0]]);
  }
  return normal;
}

/// Returns true if the corner at `i` of the ring is convex and its triangle contains no other
/// corner.
bool IsEar(
  const std::vector<glm::dvec3>& corners, const Ring& ring, std::size_t i, glm::dvec3 normal)
{
  const std::size_t size = ring.size();
  const glm::dvec3 a = corners[ring[(i + size - 1) % size]];
  const glm::dvec3 b = corners[ring[i]];
  const glm::dvec3 c = corners[ring[(i + 1) % size]];
  const auto orientation = [&](glm::dvec3 p, glm::dvec3 q, glm::dvec3 x) {
    return ComputeOrientation(p, q, x, normal);
  };
  if (orientation(a, b, c) <= 0.0)
  {
    return false;
  }
  for (std::size_t k = 2; k + 1 < size; ++k)
  {
    const glm::dvec3 x = corners[ring[(i + k) % size]];
    if (orientation(a, b, x) > 0.0 && orientation(b, c, x) > 0.0 && orientation(c, a, x) > 0.0)
    {
      return false;
    }
  }
  return true;
}

/// Balanced k-d tree with bounding boxes over the remaining corners of a ring, projected along its
/// normal.
class CornerTree
{
public:
  CornerTree(const std::vector<glm::dvec3>& corners, const Ring& ring, glm::dvec3 normal)
    : Normal(normal),
      Slots(ring.size())
  {
    const double length = glm::length(normal);
    const glm::dvec3 up = length > 0.0 ? normal / length : glm::dvec3(0.0, 0.0, 1.0);
    const glm::dvec3 axis =
      std::abs(up.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    this->Across = glm::normalize(glm::cross(axis, up));
    this->Along = glm::cross(up, this->Across);
    this->Origin = corners[ring[0]];
    double extent = 0.0;
    for (const unsigned int corner : ring)
    {
      this->Corners.push_back(corners[corner]);
      this->Projected.push_back(this->Project(corners[corner]));
      extent = std::max(
        { extent, std::abs(this->Projected.back().x), std::abs(this->Projected.back().y) });
    }
    this->Tolerance = 1e-9 * extent;
    this->SortedCorners.resize(ring.size());
    std::iota(this->SortedCorners.begin(), this->SortedCorners.end(), 0u);
    this->Build(0, 0, ring.size());
    for (std::size_t i = 0; i < this->SortedCorners.size(); ++i)
    {
      this->Slots[this->SortedCorners[i]] = i;
    }
  }

  void Remove(unsigned int corner)
  {
    std::size_t first = 0;
    std::size_t last = this->SortedCorners.size();
    for (std::size_t node = 0;;)
    {
      --this->Nodes[node].NumberOfCorners;
      if (last - first <= LeafSize)
      {
        break;
      }
      const std::size_t middle = (first + last) / 2;
      const bool upper = this->Slots[corner] >= middle;
      (upper ? first : last) = middle;
      node = 2 * node + (upper ? 2 : 1);
    }
    this->Slots[corner] = Removed;
  }

  /// Returns a corner strictly inside the triangle, except the triangle's corners, or None.
  unsigned int FindCornerInside(const unsigned int (&triangle)[3]) const
  {
    glm::dvec2 projected[3];
    for (int k = 0; k < 3; ++k)
    {
      projected[k] = this->Projected[triangle[k]];
    }
    return this->FindCornerInside(0, 0, this->SortedCorners.size(), triangle, projected);
  }

  static constexpr unsigned int None = std::numeric_limits<unsigned int>::max();

private:
  static constexpr std::size_t LeafSize = 8;
  static constexpr std::size_t Removed = std::numeric_limits<std::size_t>::max();

  struct Node
  {
    glm::dvec2 Low{ std::numeric_limits<double>::infinity() };
    glm::dvec2 High{ -std::numeric_limits<double>::infinity() };
    std::size_t NumberOfCorners = 0; ///< corners that are not removed
  };

  glm::dvec2 Project(const glm::dvec3& corner) const
  {
    const glm::dvec3 d = corner - this->Origin;
    const glm::dvec2 projected(glm::dot(d, this->Across), glm::dot(d, this->Along));
    // Orientation tests with non-finite corners are never positive, so their position is arbitrary.
    return std::isfinite(projected.x + projected.y) ? projected : glm::dvec2(0.0);
  }

  void Build(std::size_t node, std::size_t first, std::size_t last)
  {
    this->Nodes.resize(std::max(this->Nodes.size(), node + 1));
    Node built;
    for (std::size_t i = first; i < last; ++i)
    {
      built.Low = glm::min(built.Low, this->Projected[this->SortedCorners[i]]);
      built.High = glm::max(built.High, this->Projected[this->SortedCorners[i]]);
    }
    built.NumberOfCorners = last - first;
    this->Nodes[node] = built;
    if (last - first <= LeafSize)
    {
      return;
    }
    const std::size_t middle = (first + last) / 2;
    const glm::dvec2 size = built.High - built.Low;
    const int axis = size.x > size.y ? 0 : 1;
    const auto begin = this->SortedCorners.begin();
    std::nth_element(begin + static_cast<std::ptrdiff_t>(first),
      begin + static_cast<std::ptrdiff_t>(middle), begin + static_cast<std::ptrdiff_t>(last),
      [&](unsigned int a, unsigned int b) {
        return this->Projected[a][axis] < this->Projected[b][axis];
      });
    this->Build(2 * node + 1, first, middle);
    this->Build(2 * node + 2, middle, last);
  }

  /// Returns true if the box of the node and the triangle do not overlap.
  bool IsDisjoint(const Node& node, const glm::dvec2 (&triangle)[3]) const
  {
    const glm::dvec2 low =
      glm::min(glm::min(triangle[0], triangle[1]), triangle[2]) - this->Tolerance;
    const glm::dvec2 high =
      glm::max(glm::max(triangle[0], triangle[1]), triangle[2]) + this->Tolerance;
    if (node.High.x < low.x || node.High.y < low.y || node.Low.x > high.x || node.Low.y > high.y)
    {
      return true;
    }
    for (int k = 0; k < 3; ++k)
    {
      const glm::dvec2 from = triangle[k];
      const glm::dvec2 edge = triangle[(k + 1) % 3] - from;
      // The corner of the box that is farthest toward the inner side of the edge.
      const glm::dvec2 farthest(
        edge.y > 0.0 ? node.Low.x : node.High.x, edge.x > 0.0 ? node.High.y : node.Low.y);
      const double inside = edge.x * (farthest.y - from.y) - edge.y * (farthest.x - from.x);
      if (inside < -this->Tolerance * (std::abs(edge.x) + std::abs(edge.y)))
      {
        return true;
      }
    }
    return false;
  }

  unsigned int FindCornerInside(std::size_t node, std::size_t first, std::size_t last,
    const unsigned int (&triangle)[3], const glm::dvec2 (&projected)[3]) const
  {
    if (this->Nodes[node].NumberOfCorners == 0 || this->IsDisjoint(this->Nodes[node], projected))
    {
      return None;
    }
    if (last - first > LeafSize)
    {
      const std::size_t middle = (first + last) / 2;
      const unsigned int corner =
        this->FindCornerInside(2 * node + 1, first, middle, triangle, projected);
      return corner != None
        ? corner
        : this->FindCornerInside(2 * node + 2, middle, last, triangle, projected);
    }
    const glm::dvec3& a = this->Corners[triangle[0]];
    const glm::dvec3& b = this->Corners[triangle[1]];
    const glm::dvec3& c = this->Corners[triangle[2]];
    for (std::size_t i = first; i < last; ++i)
    {
      const unsigned int corner = this->SortedCorners[i];
      const glm::dvec3& x = this->Corners[corner];
      if (this->Slots[corner] != Removed && corner != triangle[0] && corner != triangle[1] &&
        corner != triangle[2] && ComputeOrientation(a, b, x, this->Normal) > 0.0 &&
        ComputeOrientation(b, c, x, this->Normal) > 0.0 &&
        ComputeOrientation(c, a, x, this->Normal) > 0.0)
      {
        return corner;
      }
    }
    return None;
  }

  glm::dvec3 Normal;
  glm::dvec3 Across;
  glm::dvec3 Along;
  glm::dvec3 Origin;
  double Tolerance = 0.0;
  std::vector<glm::dvec3> Corners;
  std::vector<glm::dvec2> Projected;
  std::vector<unsigned int> SortedCorners;
  std::vector<std::size_t> Slots; ///< positions of the corners in SortedCorners
  std::vector<Node> Nodes;        ///< the children of node i are 2 i + 1 and 2 i + 2
};

/// Ear clipping for polygons with many corners. For each corner that is not an ear, the clipper
/// stores one corner inside its triangle. The corner is tested again only after that corner or a
/// neighbor is removed.
class EarClipper
{
public:
  EarClipper(const std::vector<glm::dvec3>& corners, const Ring& ring, glm::dvec3 normal)
    : Corners(corners),
      Outline(ring),
      Normal(normal),
      Remaining(corners, ring, normal),
      Previous(ring.size()),
      Next(ring.size()),
      Blocker(ring.size(), CornerTree::None),
      Dependents(ring.size())
  {
    const auto size = static_cast<unsigned int>(ring.size());
    for (unsigned int i = 0; i < size; ++i)
    {
      this->Previous[i] = (i + size - 1) % size;
      this->Next[i] = (i + 1) % size;
      this->Candidates.insert(this->Candidates.end(), i);
    }
  }

  void Cut(std::vector<glm::uvec3>& triangles)
  {
    unsigned int current = 1;
    for (std::size_t left = this->Outline.size(); left > 3; --left)
    {
      current = this->FindNextEar(current);
      this->Add(current, triangles);
      const unsigned int next = this->Next[current];
      this->Remove(current);
      current = next;
    }
    this->Add(current, triangles);
  }

private:
  void Add(unsigned int current, std::vector<glm::uvec3>& triangles) const
  {
    triangles.emplace_back(this->Outline[this->Previous[current]], this->Outline[current],
      this->Outline[this->Next[current]]);
  }

  /// Returns the first ear from `current` on, or `current` if no corner is an ear.
  unsigned int FindNextEar(unsigned int current)
  {
    while (!this->Candidates.empty())
    {
      auto candidate = this->Candidates.lower_bound(current);
      candidate = candidate != this->Candidates.end() ? candidate : this->Candidates.begin();
      if (this->IsEar(*candidate))
      {
        return *candidate;
      }
      this->Candidates.erase(candidate);
    }
    return current;
  }

  bool IsEar(unsigned int current)
  {
    const unsigned int triangle[3] = { this->Previous[current], current, this->Next[current] };
    this->Blocker[current] = CornerTree::None;
    if (ComputeOrientation(this->Corners[this->Outline[triangle[0]]],
          this->Corners[this->Outline[current]], this->Corners[this->Outline[triangle[2]]],
          this->Normal) <= 0.0)
    {
      return false;
    }
    const unsigned int corner = this->Remaining.FindCornerInside(triangle);
    if (corner == CornerTree::None)
    {
      return true;
    }
    this->Blocker[current] = corner;
    this->Dependents[corner].push_back(current);
    return false;
  }

  void Remove(unsigned int current)
  {
    const unsigned int previous = this->Previous[current];
    const unsigned int next = this->Next[current];
    this->Next[previous] = next;
    this->Previous[next] = previous;
    this->Remaining.Remove(current);
    for (const unsigned int dependent : this->Dependents[current])
    {
      if (this->Blocker[dependent] == current)
      {
        this->Candidates.insert(dependent);
      }
    }
    this->Blocker[current] = CornerTree::None;
    this->Candidates.insert(previous);
    this->Candidates.insert(next);
    this->Candidates.erase(current);
  }

  const std::vector<glm::dvec3>& Corners;
  const Ring& Outline;
  const glm::dvec3 Normal;
  CornerTree Remaining;
  std::vector<unsigned int> Previous;
  std::vector<unsigned int> Next;
  std::vector<unsigned int> Blocker; ///< a corner inside the triangle of each corner, or None
  std::vector<std::vector<unsigned int>>
    Dependents;                      ///< corners to test again when this one is removed
  std::set<unsigned int> Candidates; ///< corners that may be ears
};

}

void TriangulatePolygon(const std::vector<glm::dvec3>& corners, std::vector<glm::uvec3>& triangles)
{
  triangles.clear();
  Ring ring = CollectDistinctCorners(corners);
  if (ring.size() < 3)
  {
    return;
  }
  const glm::dvec3 normal = ComputeNormal(corners, ring);
  if (ring.size() >= MinimumCornersForTree)
  {
    EarClipper(corners, ring, normal).Cut(triangles);
    return;
  }
  std::size_t i = 1;
  std::size_t rejected = 0;
  while (ring.size() > 3)
  {
    i %= ring.size();
    if (rejected < ring.size() && !IsEar(corners, ring, i, normal))
    {
      ++i;
      ++rejected;
      continue;
    }
    // The corner is an ear, or there is none because the outline intersects itself. Remove the
    // corner in both cases.
    const std::size_t size = ring.size();
    triangles.emplace_back(ring[(i + size - 1) % size], ring[i], ring[(i + 1) % size]);
    ring.erase(ring.begin() + static_cast<Ring::difference_type>(i));
    rejected = 0;
  }
  i %= 3;
  triangles.emplace_back(ring[(i + 2) % 3], ring[i], ring[(i + 1) % 3]);
}

}
