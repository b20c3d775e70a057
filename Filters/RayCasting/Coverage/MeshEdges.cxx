// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshEdges.h"

#include <algorithm>
#include <cstring>

namespace penumbra
{

namespace
{

using Index = std::uint32_t;

struct HalfEdge
{
  Index To;          ///< the canonical position with the larger index
  Index Triangle;    ///< the triangle that contains the half-edge
  std::uint8_t Side; ///< the half-edge runs from corner Side to corner Side + 1
};

/// Returns for every position the index of the first position with equal coordinates.
std::vector<Index> MergePositions(const std::vector<glm::vec3>& positions)
{
  std::size_t size = 16;
  while (size < 2 * positions.size())
  {
    size *= 2;
  }
  constexpr Index Free = 0xffffffffu;
  std::vector<Index> table(size, Free);
  std::vector<Index> canonical(positions.size());
  for (Index i = 0; i < positions.size(); ++i)
  {
    const glm::vec3 p = positions[i] + glm::vec3(0.f); // turns -0 into 0
    std::uint32_t bits[3];
    std::memcpy(bits, &p, sizeof(bits));
    std::uint64_t hash = bits[0] * 0x9e3779b97f4a7c15ull;
    hash = (hash ^ (hash >> 29) ^ bits[1]) * 0xbf58476d1ce4e5b9ull;
    hash = (hash ^ (hash >> 32) ^ bits[2]) * 0x94d049bb133111ebull;
    std::size_t slot = (hash ^ (hash >> 31)) & (size - 1);
    while (table[slot] != Free && positions[table[slot]] != positions[i])
    {
      slot = (slot + 1) & (size - 1);
    }
    if (table[slot] == Free)
    {
      table[slot] = i;
    }
    canonical[i] = table[slot];
  }
  return canonical;
}

/// Half-edges grouped by their smaller position; those of position v are Edges[Begin[v]] to
/// Edges[Begin[v + 1] - 1].
struct HalfEdges
{
  std::vector<Index> Begin;
  std::vector<HalfEdge> Edges;

  HalfEdges(const Surface& surface, const std::vector<Index>& canonical)
    : Begin(surface.Positions.size() + 1, 0),
      Edges(3 * surface.Triangles.size())
  {
    const auto corner = [&](Index triangle, int side) {
      return canonical[surface.Triangles[triangle][side % 3]];
    };
    const Index count = static_cast<Index>(surface.Triangles.size());
    for (Index t = 0; t < count; ++t)
    {
      for (int side = 0; side < 3; ++side)
      {
        ++this->Begin[std::min(corner(t, side), corner(t, side + 1)) + 1];
      }
    }
    for (std::size_t v = 1; v < this->Begin.size(); ++v)
    {
      this->Begin[v] += this->Begin[v - 1];
    }
    std::vector<Index> next(this->Begin.begin(), this->Begin.end() - 1);
    for (Index t = 0; t < count; ++t)
    {
      for (int side = 0; side < 3; ++side)
      {
        const Index a = corner(t, side);
        const Index b = corner(t, side + 1);
        this->Edges[next[std::min(a, b)]++] = { std::max(a, b), t,
          static_cast<std::uint8_t>(side) };
      }
    }
  }
};

/// Decides whether an edge between two triangles is a feature edge.
class CreaseTest
{
public:
  CreaseTest(const Surface& surface, double contrast)
    : Mesh(surface),
      NormalLimit(contrast * contrast),
      ColorLimit(static_cast<int>(contrast * 255.0))
  {
  }

  /// Returns true if the image may be discontinuous between the two triangles of the edge.
  bool operator()(const HalfEdge& e, const HalfEdge& f) const
  {
    const Surface& s = this->Mesh;
    const Index a[2] = { s.Triangles[e.Triangle][e.Side],
      s.Triangles[e.Triangle][(e.Side + 1) % 3] };
    Index b[2] = { s.Triangles[f.Triangle][(f.Side + 1) % 3], s.Triangles[f.Triangle][f.Side] };
    if (s.Positions[a[0]] != s.Positions[b[0]])
    {
      return true; // the triangles have opposite orientations
    }
    if (!s.CellColors.empty() &&
      this->ColorsDiffer(s.CellColors[e.Triangle], s.CellColors[f.Triangle]))
    {
      return true;
    }
    if (s.Normals.empty())
    {
      return this->NormalsDiffer(this->FlatNormal(e.Triangle), this->FlatNormal(f.Triangle));
    }
    for (int end = 0; end < 2; ++end)
    {
      if (a[end] == b[end])
      {
        continue;
      }
      if (this->NormalsDiffer(s.Normals[a[end]], s.Normals[b[end]]) ||
        (!s.PointColors.empty() &&
          this->ColorsDiffer(s.PointColors[a[end]], s.PointColors[b[end]])))
      {
        return true;
      }
    }
    return false;
  }

private:
  glm::dvec3 FlatNormal(Index triangle) const
  {
    const glm::uvec3 t = this->Mesh.Triangles[triangle];
    const glm::dvec3 a(this->Mesh.Positions[t.x]);
    const glm::dvec3 n = glm::cross(
      glm::dvec3(this->Mesh.Positions[t.y]) - a, glm::dvec3(this->Mesh.Positions[t.z]) - a);
    const double length = glm::length(n);
    return length > 0.0 ? n / length : n;
  }

  bool NormalsDiffer(const glm::dvec3& m, const glm::dvec3& n) const
  {
    const glm::dvec3 d = m - n;
    return glm::dot(d, d) > this->NormalLimit;
  }

  bool ColorsDiffer(const glm::u8vec4& c, const glm::u8vec4& d) const
  {
    const glm::ivec4 e = glm::abs(glm::ivec4(c) - glm::ivec4(d));
    return std::max(std::max(e.x, e.y), std::max(e.z, e.w)) > this->ColorLimit;
  }

  const Surface& Mesh;
  double NormalLimit;
  int ColorLimit;
};

}

std::vector<MeshEdge> FindMeshEdges(const Surface& surface, double contrast)
{
  const std::vector<Index> canonical = MergePositions(surface.Positions);
  HalfEdges half(surface, canonical);
  const CreaseTest crease(surface, contrast);
  const auto opposite = [&](const HalfEdge& e) {
    return surface.Triangles[e.Triangle][(e.Side + 2) % 3];
  };

  std::vector<MeshEdge> edges;
  edges.reserve(half.Edges.size() / 2 + 16);
  for (Index v = 0; v < surface.Positions.size(); ++v)
  {
    HalfEdge* begin = half.Edges.data() + half.Begin[v];
    HalfEdge* end = half.Edges.data() + half.Begin[v + 1];
    std::sort(begin, end, [](const HalfEdge& a, const HalfEdge& b) {
      return a.To != b.To ? a.To < b.To : a.Triangle < b.Triangle;
    });
    while (begin != end)
    {
      HalfEdge* next = begin;
      while (next != end && next->To == begin->To)
      {
        ++next;
      }
      if (begin->To != v) // skip edges of zero length
      {
        const bool pair = next - begin == 2;
        const HalfEdge& other = pair ? begin[1] : begin[0];
        edges.push_back(
          { v, begin->To, opposite(*begin), opposite(other), !pair || crease(*begin, other) });
      }
      begin = next;
    }
  }
  return edges;
}

}
