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

/// From so many corners on it pays to remember what stands in the way of each.
constexpr std::size_t ManyCorners = 64;

/// Twice the signed area of a triangle as seen along `normal`, times its length.
double Side(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& x, const glm::dvec3& normal)
{
  return glm::dot(glm::cross(q - p, x - p), normal);
}

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
  const auto side = [&](glm::dvec3 p, glm::dvec3 q, glm::dvec3 x) { return Side(p, q, x, normal); };
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

/// The corners of a ring that are left, as seen along its normal, found by place: a balanced tree of boxes.
class CornerTree
{
public:
  CornerTree(const std::vector<glm::dvec3>& corners, const Ring& ring, glm::dvec3 normal)
    : Normal(normal),
      Places(ring.size())
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
      this->Flat.push_back(this->Flatten(corners[corner]));
      extent = std::max({ extent, std::abs(this->Flat.back().x), std::abs(this->Flat.back().y) });
    }
    this->Slack = 1e-9 * extent;
    this->Order.resize(ring.size());
    std::iota(this->Order.begin(), this->Order.end(), 0u);
    this->Grow(0, 0, ring.size());
    for (std::size_t i = 0; i < this->Order.size(); ++i)
    {
      this->Places[this->Order[i]] = i;
    }
  }

  void Remove(unsigned int corner)
  {
    std::size_t first = 0;
    std::size_t last = this->Order.size();
    for (std::size_t node = 0;;)
    {
      --this->Nodes[node].Left;
      if (last - first <= LeafSize)
      {
        break;
      }
      const std::size_t middle = (first + last) / 2;
      const bool upper = this->Places[corner] >= middle;
      (upper ? first : last) = middle;
      node = 2 * node + (upper ? 2 : 1);
    }
    this->Places[corner] = Gone;
  }

  /// A corner strictly within the triangle, other than its own; None where there is none.
  unsigned int FindWithin(const unsigned int (&triangle)[3]) const
  {
    glm::dvec2 flat[3];
    for (int k = 0; k < 3; ++k)
    {
      flat[k] = this->Flat[triangle[k]];
    }
    return this->FindWithin(0, 0, this->Order.size(), triangle, flat);
  }

  static constexpr unsigned int None = std::numeric_limits<unsigned int>::max();

private:
  static constexpr std::size_t LeafSize = 8;
  static constexpr std::size_t Gone = std::numeric_limits<std::size_t>::max();

  struct Node
  {
    glm::dvec2 Low{ std::numeric_limits<double>::infinity() };
    glm::dvec2 High{ -std::numeric_limits<double>::infinity() };
    std::size_t Left = 0; ///< corners that were not removed
  };

  glm::dvec2 Flatten(const glm::dvec3& corner) const
  {
    const glm::dvec3 d = corner - this->Origin;
    const glm::dvec2 flat(glm::dot(d, this->Across), glm::dot(d, this->Along));
    // No triangle has a side next to what is not finite, so its place does not matter.
    return std::isfinite(flat.x + flat.y) ? flat : glm::dvec2(0.0);
  }

  void Grow(std::size_t node, std::size_t first, std::size_t last)
  {
    this->Nodes.resize(std::max(this->Nodes.size(), node + 1));
    Node grown;
    for (std::size_t i = first; i < last; ++i)
    {
      grown.Low = glm::min(grown.Low, this->Flat[this->Order[i]]);
      grown.High = glm::max(grown.High, this->Flat[this->Order[i]]);
    }
    grown.Left = last - first;
    this->Nodes[node] = grown;
    if (last - first <= LeafSize)
    {
      return;
    }
    const std::size_t middle = (first + last) / 2;
    const glm::dvec2 size = grown.High - grown.Low;
    const int axis = size.x > size.y ? 0 : 1;
    const auto begin = this->Order.begin();
    std::nth_element(begin + static_cast<std::ptrdiff_t>(first),
      begin + static_cast<std::ptrdiff_t>(middle), begin + static_cast<std::ptrdiff_t>(last),
      [&](unsigned int a, unsigned int b) { return this->Flat[a][axis] < this->Flat[b][axis]; });
    this->Grow(2 * node + 1, first, middle);
    this->Grow(2 * node + 2, middle, last);
  }

  /// Can none of the box lie within the triangle?
  bool IsApart(const Node& node, const glm::dvec2 (&triangle)[3]) const
  {
    const glm::dvec2 low = glm::min(glm::min(triangle[0], triangle[1]), triangle[2]) - this->Slack;
    const glm::dvec2 high = glm::max(glm::max(triangle[0], triangle[1]), triangle[2]) + this->Slack;
    if (node.High.x < low.x || node.High.y < low.y || node.Low.x > high.x || node.Low.y > high.y)
    {
      return true;
    }
    for (int k = 0; k < 3; ++k)
    {
      const glm::dvec2 from = triangle[k];
      const glm::dvec2 edge = triangle[(k + 1) % 3] - from;
      // The corner of the box that lies farthest on the inner side.
      const glm::dvec2 far(
        edge.y > 0.0 ? node.Low.x : node.High.x, edge.x > 0.0 ? node.High.y : node.Low.y);
      const double inside = edge.x * (far.y - from.y) - edge.y * (far.x - from.x);
      if (inside < -this->Slack * (std::abs(edge.x) + std::abs(edge.y)))
      {
        return true;
      }
    }
    return false;
  }

  unsigned int FindWithin(std::size_t node, std::size_t first, std::size_t last,
    const unsigned int (&triangle)[3], const glm::dvec2 (&flat)[3]) const
  {
    if (this->Nodes[node].Left == 0 || this->IsApart(this->Nodes[node], flat))
    {
      return None;
    }
    if (last - first > LeafSize)
    {
      const std::size_t middle = (first + last) / 2;
      const unsigned int found = this->FindWithin(2 * node + 1, first, middle, triangle, flat);
      return found != None ? found : this->FindWithin(2 * node + 2, middle, last, triangle, flat);
    }
    const glm::dvec3& a = this->Corners[triangle[0]];
    const glm::dvec3& b = this->Corners[triangle[1]];
    const glm::dvec3& c = this->Corners[triangle[2]];
    for (std::size_t i = first; i < last; ++i)
    {
      const unsigned int corner = this->Order[i];
      const glm::dvec3& x = this->Corners[corner];
      if (this->Places[corner] != Gone && corner != triangle[0] && corner != triangle[1] &&
        corner != triangle[2] && Side(a, b, x, this->Normal) > 0.0 &&
        Side(b, c, x, this->Normal) > 0.0 && Side(c, a, x, this->Normal) > 0.0)
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
  double Slack = 0.0;
  std::vector<glm::dvec3> Corners;
  std::vector<glm::dvec2> Flat;
  std::vector<unsigned int> Order;
  std::vector<std::size_t> Places; ///< in Order
  std::vector<Node> Nodes;         ///< the children of i are 2 i + 1 and 2 i + 2
};

/// The walk of TriangulatePolygon for many corners. A corner that is no ear remembers which other one
/// lies in the way, and is not asked again before that one or a neighbour is cut off.
class Walk
{
public:
  Walk(const std::vector<glm::dvec3>& corners, const Ring& ring, glm::dvec3 normal)
    : Corners(corners),
      Outline(ring),
      Normal(normal),
      Left(corners, ring, normal),
      Before(ring.size()),
      After(ring.size()),
      Obstacle(ring.size(), CornerTree::None),
      Waiting(ring.size())
  {
    const auto size = static_cast<unsigned int>(ring.size());
    for (unsigned int i = 0; i < size; ++i)
    {
      this->Before[i] = (i + size - 1) % size;
      this->After[i] = (i + 1) % size;
      this->Candidates.insert(this->Candidates.end(), i);
    }
  }

  void Cut(std::vector<glm::uvec3>& triangles)
  {
    unsigned int at = 1;
    for (std::size_t left = this->Outline.size(); left > 3; --left)
    {
      at = this->NextEar(at);
      this->Add(at, triangles);
      const unsigned int next = this->After[at];
      this->Remove(at);
      at = next;
    }
    this->Add(at, triangles);
  }

private:
  void Add(unsigned int at, std::vector<glm::uvec3>& triangles) const
  {
    triangles.emplace_back(
      this->Outline[this->Before[at]], this->Outline[at], this->Outline[this->After[at]]);
  }

  /// From `at` on; `at` itself when no ear is left.
  unsigned int NextEar(unsigned int at)
  {
    while (!this->Candidates.empty())
    {
      auto candidate = this->Candidates.lower_bound(at);
      candidate = candidate != this->Candidates.end() ? candidate : this->Candidates.begin();
      if (this->IsEar(*candidate))
      {
        return *candidate;
      }
      this->Candidates.erase(candidate);
    }
    return at;
  }

  bool IsEar(unsigned int at)
  {
    const unsigned int triangle[3] = { this->Before[at], at, this->After[at] };
    this->Obstacle[at] = CornerTree::None;
    if (Side(this->Corners[this->Outline[triangle[0]]], this->Corners[this->Outline[at]],
          this->Corners[this->Outline[triangle[2]]], this->Normal) <= 0.0)
    {
      return false;
    }
    const unsigned int found = this->Left.FindWithin(triangle);
    if (found == CornerTree::None)
    {
      return true;
    }
    this->Obstacle[at] = found;
    this->Waiting[found].push_back(at);
    return false;
  }

  void Remove(unsigned int at)
  {
    const unsigned int before = this->Before[at];
    const unsigned int after = this->After[at];
    this->After[before] = after;
    this->Before[after] = before;
    this->Left.Remove(at);
    for (const unsigned int waiting : this->Waiting[at])
    {
      if (this->Obstacle[waiting] == at)
      {
        this->Candidates.insert(waiting);
      }
    }
    this->Obstacle[at] = CornerTree::None;
    this->Candidates.insert(before);
    this->Candidates.insert(after);
    this->Candidates.erase(at);
  }

  const std::vector<glm::dvec3>& Corners;
  const Ring& Outline;
  const glm::dvec3 Normal;
  CornerTree Left;
  std::vector<unsigned int> Before;
  std::vector<unsigned int> After;
  std::vector<unsigned int> Obstacle;             ///< of each corner the one in its way
  std::vector<std::vector<unsigned int>> Waiting; ///< for each corner to go
  std::set<unsigned int> Candidates;              ///< those that may be ears
};

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
  if (ring.size() >= ManyCorners)
  {
    Walk(corners, ring, normal).Cut(triangles);
    return;
  }
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
