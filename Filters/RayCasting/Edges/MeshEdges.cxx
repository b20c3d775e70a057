// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshEdges.h"

#include "EdgeConstants.h"
#include "Execution/ParallelBins.h"
#include "Surface.h"
#include "UnsteadyNormals.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <tuple>

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

  bool operator<(const HalfEdge& other) const
  {
    return std::tie(this->To, this->Triangle, this->Side) <
      std::tie(other.To, other.Triangle, other.Side);
  }
};

std::uint64_t HashPosition(const glm::vec3& position)
{
  const glm::vec3 p = position + glm::vec3(0.f); // turns -0 into 0
  std::uint32_t bits[3];
  std::memcpy(bits, &p, sizeof(bits));
  std::uint64_t hash = bits[0] * 0x9e3779b97f4a7c15ull;
  hash = (hash ^ (hash >> 29) ^ bits[1]) * 0xbf58476d1ce4e5b9ull;
  hash = (hash ^ (hash >> 32) ^ bits[2]) * 0x94d049bb133111ebull;
  return hash ^ (hash >> 31);
}

/// Sets canonical[i] to the first of `count` ascending indices whose position is that of i.
void MergeGroup(const std::vector<glm::vec3>& positions, const Index* indices, std::size_t count,
  std::vector<Index>& canonical)
{
  std::size_t size = 16;
  while (size < 2 * count)
  {
    size *= 2;
  }
  constexpr Index Free = 0xffffffffu;
  std::vector<Index> table(size, Free);
  for (std::size_t k = 0; k < count; ++k)
  {
    const Index i = indices[k];
    std::size_t slot = HashPosition(positions[i]) & (size - 1);
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
}

/// Returns for every position the index of the first position with equal coordinates.
std::vector<Index> MergePositions(const std::vector<glm::vec3>& positions)
{
  // Groups of positions with equal hashes, modulo their number, are merged in parallel.
  constexpr std::size_t MaximumGroups = 1024;
  const std::size_t groups =
    std::clamp<std::size_t>(positions.size() / ArrayGrain, 1, MaximumGroups);
  Bins<Index> indices;
  indices.Fill(positions.size(), groups, [&](std::size_t first, std::size_t last, const auto& add) {
    for (std::size_t i = first; i < last; ++i)
    {
      // The lower digits select the slot in the group.
      add((HashPosition(positions[i]) >> 40) % groups, static_cast<Index>(i));
    }
  });
  std::vector<Index> canonical(positions.size());
  ParallelFor<std::size_t>(0, groups, 1, [&](std::size_t group) {
    MergeGroup(positions, indices.Get(group), indices.GetCount(group), canonical);
  });
  return canonical;
}

/// Calls visit(t) for the indices of all triangles in parallel.
template <typename Visit>
void VisitTriangles(const Surface& surface, const Visit& visit)
{
  const std::vector<std::size_t> boundaries = SplitIntoParts(surface.Triangles.size(), ArrayGrain);
  ParallelFor<std::size_t>(0, boundaries.size() - 1, 1, [&](std::size_t part) {
    for (std::size_t t = boundaries[part]; t < boundaries[part + 1]; ++t)
    {
      visit(static_cast<Index>(t));
    }
  });
}

/// Adds to a counter that several threads change. Returns its value before.
Index Add(std::atomic<Index>& counter, Index summand)
{
  return counter.fetch_add(summand, std::memory_order_relaxed);
}

/// Half-edges between two positions that are kept, grouped by their smaller position; those of
/// position v are Edges[Begin[v]] to Edges[Begin[v + 1] - 1].
struct HalfEdges
{
  std::vector<Index> Begin;
  std::vector<HalfEdge> Edges;

  template <typename IsKept>
  HalfEdges(const Surface& surface, const std::vector<Index>& canonical, IsKept isKept)
  {
    // Calls visit(from, half-edge) for the half-edges of all triangles in parallel.
    const auto visitAll = [&](const auto& visit) {
      VisitTriangles(surface, [&](Index t) {
        const glm::uvec3 corners = surface.Triangles[t];
        for (int side = 0; side < 3; ++side)
        {
          const Index a = canonical[corners[side]];
          const Index b = canonical[corners[(side + 1) % 3]];
          if (isKept(a) && isKept(b))
          {
            visit(std::min(a, b), HalfEdge{ std::max(a, b), t, static_cast<std::uint8_t>(side) });
          }
        }
      });
    };
    std::vector<std::atomic<Index>> next(surface.Positions.size() + 1);
    visitAll([&](Index from, const HalfEdge&) { Add(next[from], 1); });
    this->Begin.resize(next.size());
    Index sum = 0;
    for (std::size_t v = 0; v < next.size(); ++v)
    {
      this->Begin[v] = sum;
      sum += next[v].exchange(sum, std::memory_order_relaxed);
    }
    this->Edges.resize(sum);
    // The order around a position depends on the threads. VisitEdges() sorts them.
    visitAll([&](Index from, const HalfEdge& edge) { this->Edges[Add(next[from], 1)] = edge; });
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

/// Calls visit(first, count) for the half-edges of every edge from `v` that is not of zero length.
template <typename Visit>
void VisitEdgesFrom(Index v, HalfEdges& half, Visit visit)
{
  HalfEdge* begin = half.Edges.data() + half.Begin[v];
  HalfEdge* end = half.Edges.data() + half.Begin[v + 1];
  while (begin != end)
  {
    HalfEdge* next = begin;
    while (next != end && next->To == begin->To)
    {
      ++next;
    }
    if (begin->To != v)
    {
      visit(begin, next - begin);
    }
    begin = next;
  }
}

/// Returns make(v, first, count) for the half-edges of every edge that is not of zero length.
template <typename Make>
std::vector<MeshEdge> MakeEdges(HalfEdges& half, Make make)
{
  const std::vector<std::size_t> boundaries = SplitIntoParts(half.Begin.size() - 1, ArrayGrain);
  const std::size_t parts = boundaries.size() - 1;
  std::vector<std::size_t> next(parts + 1, 0);
  ParallelFor<std::size_t>(0, parts, 1, [&](std::size_t part) {
    std::size_t count = 0;
    for (std::size_t v = boundaries[part]; v < boundaries[part + 1]; ++v)
    {
      std::sort(half.Edges.data() + half.Begin[v], half.Edges.data() + half.Begin[v + 1]);
      VisitEdgesFrom(
        static_cast<Index>(v), half, [&](const HalfEdge*, std::ptrdiff_t) { ++count; });
    }
    next[part + 1] = count;
  });
  for (std::size_t part = 0; part < parts; ++part)
  {
    next[part + 1] += next[part];
  }
  std::vector<MeshEdge> edges(next[parts]);
  ParallelFor<std::size_t>(0, parts, 1, [&](std::size_t part) {
    std::size_t at = next[part];
    for (std::size_t v = boundaries[part]; v < boundaries[part + 1]; ++v)
    {
      VisitEdgesFrom(static_cast<Index>(v), half, [&](const HalfEdge* first, std::ptrdiff_t count) {
        edges[at++] = make(static_cast<Index>(v), first, count);
      });
    }
  });
  return edges;
}

MeshEdge MakeEdge(const Surface& surface, Index v, const HalfEdge* half, bool pair, bool isFeature)
{
  const auto opposite = [&](const HalfEdge& e) {
    return surface.Triangles[e.Triangle][(e.Side + 2) % 3];
  };
  // The order of the indices may be another one in a part of a surface, see Surface::Whole.
  const glm::vec3 a = surface.Positions[v];
  const glm::vec3 b = surface.Positions[half->To];
  const bool isOrdered = std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  return { isOrdered ? v : half->To, isOrdered ? half->To : v, opposite(half[0]),
    opposite(half[pair ? 1 : 0]), isFeature };
}

/// Finds the positions whose edges may be silhouettes, boundaries, seams or sides of large
/// triangles, in one pass over the triangles.
class PositionFlags
{
public:
  PositionFlags(const Surface& surface, const std::vector<Index>& canonical, const Camera& camera)
    : Mesh(surface),
      View(camera),
      Eye(camera.Position),
      Forward(camera.Forward),
      LargeSquare(static_cast<float>(
        LargeTriangleSide * camera.PixelSize * LargeTriangleSide * camera.PixelSize)),
      Flags(surface.Positions.size())
  {
    // The triangles around an inner position form a cycle: every neighbor is the next of one
    // triangle and the previous of another, so the differences of their hashes cancel. Seams have
    // neighbors with different normals or colors, so they do not cancel.
    std::vector<std::atomic<Index>> cycles(surface.Positions.size());
    VisitTriangles(surface, [&](Index t) {
      const glm::uvec3 corners = surface.Triangles[t];
      const std::uint8_t flags = this->Classify(t);
      std::uint32_t hashes[3];
      for (int i = 0; i < 3; ++i)
      {
        hashes[i] = this->Hash(corners[i], canonical[corners[i]]);
      }
      for (int i = 0; i < 3; ++i)
      {
        const Index v = canonical[corners[i]];
        // Most positions have the flags already, so this rarely waits for other threads.
        if ((this->Flags[v].load(std::memory_order_relaxed) & flags) != flags)
        {
          this->Flags[v].fetch_or(flags, std::memory_order_relaxed);
        }
        Add(cycles[v], hashes[(i + 1) % 3] - hashes[(i + 2) % 3]);
      }
    });
    ParallelFor<std::size_t>(0, this->Flags.size(), ArrayGrain, [&](std::size_t v) {
      const std::uint8_t flags = this->Flags[v].load(std::memory_order_relaxed);
      const bool isKept =
        (flags & (Front | Back)) == (Front | Back) || (flags & Large) || cycles[v] != 0;
      this->Flags[v].store(isKept ? 1 : 0, std::memory_order_relaxed);
    });
  }

  /// Returns true if the position lies on an edge to be found.
  bool operator()(Index v) const { return this->Flags[v].load(std::memory_order_relaxed) != 0; }

  /// Returns true if the triangle has feature edges that are not smaller than pixels.
  bool IsLarge(Index triangle) const
  {
    const glm::uvec3 t = this->Mesh.Triangles[triangle];
    const glm::dvec3 p[3] = { glm::dvec3(this->Mesh.Positions[t.x]),
      glm::dvec3(this->Mesh.Positions[t.y]), glm::dvec3(this->Mesh.Positions[t.z]) };
    double square = 0.0;
    double depth = this->View.Parallel ? 1.0 : this->View.Depth(p[0]);
    for (int i = 0; i < 3; ++i)
    {
      const glm::dvec3 d = p[i] - p[(i + 1) % 3];
      square = std::max(square, glm::dot(d, d));
      depth = this->View.Parallel ? 1.0 : std::min(depth, this->View.Depth(p[i]));
    }
    const double limit = LargeTriangleSide * this->View.PixelSize * std::max(depth, 0.0);
    return square > limit * limit;
  }

private:
  static constexpr std::uint8_t Front = 1;
  static constexpr std::uint8_t Back = 2;
  static constexpr std::uint8_t Large = 4;

  std::uint8_t Classify(Index triangle) const
  {
    const glm::uvec3 t = this->Mesh.Triangles[triangle];
    const glm::vec3 a = this->Mesh.Positions[t.x];
    const glm::vec3 d = this->Mesh.Positions[t.y] - a;
    const glm::vec3 e = this->Mesh.Positions[t.z] - a;
    const glm::vec3 view = this->View.Parallel ? this->Forward : a - this->Eye;
    const float volume = glm::dot(glm::cross(d, e), view);
    // In doubt the triangle faces both ways, which only adds candidates.
    const float dd = glm::dot(d, d);
    const float ee = glm::dot(e, e);
    const float doubt = FacingPrecision * FacingPrecision * dd * ee * glm::dot(view, view);
    std::uint8_t flags = volume * volume <= doubt ? Front | Back : volume > 0.f ? Back : Front;
    // Smooth surfaces have no creases. A cheap bound on the sides excludes most triangles.
    const float depth = this->View.Parallel ? 1.f : glm::dot(view, this->Forward);
    if (this->Mesh.Normals.empty() && !(4.f * (dd + ee) < this->LargeSquare * depth * depth) &&
      this->IsLarge(triangle))
    {
      flags |= Large;
    }
    return flags;
  }

  std::uint32_t Hash(Index corner, Index canonical) const
  {
    std::uint64_t hash = canonical * 0x9e3779b97f4a7c15ull;
    const auto add = [&](std::uint32_t bits) {
      hash = (hash ^ (hash >> 29) ^ bits) * 0xbf58476d1ce4e5b9ull;
    };
    if (!this->Mesh.Normals.empty())
    {
      const glm::vec3 n = this->Mesh.Normals[corner] + glm::vec3(0.f);
      std::uint32_t bits[3];
      std::memcpy(bits, &n, sizeof(bits));
      add(bits[0]);
      add(bits[1]);
      add(bits[2]);
    }
    if (!this->Mesh.PointColors.empty())
    {
      std::uint32_t bits;
      std::memcpy(&bits, &this->Mesh.PointColors[corner], sizeof(bits));
      add(bits);
    }
    return static_cast<std::uint32_t>(hash >> 32);
  }

  /// Sine of the angle between triangle and ray below which the triangle may face both ways.
  static constexpr float FacingPrecision = 1e-4f;

  const Surface& Mesh;
  const Camera& View;
  const glm::vec3 Eye;
  const glm::vec3 Forward;
  const float LargeSquare; ///< of LargeTriangleSide at depth 1
  std::vector<std::atomic<std::uint8_t>> Flags;
};

}

std::vector<MeshEdge> FindMeshEdges(const Surface& surface, double contrast, bool isUnsteady)
{
  const std::vector<Index> canonical = MergePositions(surface.Positions);
  HalfEdges half(surface, canonical, [](Index) { return true; });
  const CreaseTest crease(surface, contrast);
  return MakeEdges(half, [&](Index v, const HalfEdge* e, std::ptrdiff_t count) {
    const bool pair = count == 2;
    const bool isUnsteadyEdge = pair && isUnsteady &&
      (HasUnsteadyNormal(surface, e[0].Triangle) || HasUnsteadyNormal(surface, e[1].Triangle));
    return MakeEdge(surface, v, e, pair, !pair || isUnsteadyEdge || crease(e[0], e[1]));
  });
}

std::vector<MeshEdge> FindEdgesOfDenseMesh(
  const Surface& surface, double contrast, const Camera& camera)
{
  const std::vector<Index> canonical = MergePositions(surface.Positions);
  const PositionFlags flags(surface, canonical, camera);
  HalfEdges half(surface, canonical, [&](Index v) { return flags(v); });
  const CreaseTest crease(surface, contrast);
  return MakeEdges(half, [&](Index v, const HalfEdge* e, std::ptrdiff_t count) {
    const bool pair = count == 2;
    const bool keepCreases = pair &&
      (!surface.Normals.empty() || flags.IsLarge(e[0].Triangle) || flags.IsLarge(e[1].Triangle));
    return MakeEdge(surface, v, e, pair, !pair || (keepCreases && crease(e[0], e[1])));
  });
}

}
