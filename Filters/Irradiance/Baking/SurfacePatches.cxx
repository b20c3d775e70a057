// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfacePatches.h"

#include "Gathering/IrradianceConstants.h"
#include "Surface.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <vector>

namespace penumbra
{
namespace
{

constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

class PatchLabels
{
public:
  explicit PatchLabels(const BakeInput& mesh)
    : Mesh(mesh),
      Own(mesh.OccluderScene.Surfaces.front()),
      Parents(mesh.GetNumberOfCornerLists())
  {
    std::iota(this->Parents.begin(), this->Parents.end(), 0u);
  }

  void ConnectPoints()
  {
    std::vector<std::uint32_t> sites(this->Own.Positions.size(), None);
    for (std::uint32_t site = 0; site < this->Parents.size(); ++site)
    {
      sites[this->Mesh.Corners[site]] = site;
    }
    for (const glm::uvec3& corners : this->Own.Triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        this->Connect(sites[corners[k]], sites[corners[(k + 1) % 3]]);
      }
    }
    const std::vector<std::uint32_t> order = this->SortPositions();
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      for (std::size_t k = i + 1; k < order.size() && k < i + MaximumNeighbors &&
           this->Own.Positions[order[k]] == this->Own.Positions[order[i]];
           ++k)
      {
        this->Connect(sites[order[i]], sites[order[k]]);
      }
    }
  }

  void ConnectCells()
  {
    struct Edge
    {
      std::uint32_t Low, High, Site;
    };
    const std::vector<std::uint32_t> firsts = this->FindFirsts();
    std::vector<Edge> edges;
    edges.reserve(this->Mesh.Corners.size());
    for (std::uint32_t site = 0; site < this->Parents.size(); ++site)
    {
      const auto [first, last] = this->Mesh.GetCorners(site);
      for (const std::uint32_t* corner = first; corner < last; ++corner)
      {
        const std::uint32_t from = firsts[*corner];
        const std::uint32_t to = firsts[corner + 1 == last ? *first : corner[1]];
        edges.push_back({ std::min(from, to), std::max(from, to), site });
      }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
      return std::tie(a.Low, a.High, a.Site) < std::tie(b.Low, b.High, b.Site);
    });
    for (std::size_t i = 0; i < edges.size(); ++i)
    {
      for (std::size_t k = i + 1; k < edges.size() && k < i + MaximumNeighbors &&
           edges[k].Low == edges[i].Low && edges[k].High == edges[i].High;
           ++k)
      {
        this->Connect(edges[i].Site, edges[k].Site);
      }
    }
  }

  std::uint32_t Find(std::uint32_t site)
  {
    while (this->Parents[site] != site)
    {
      this->Parents[site] = this->Parents[this->Parents[site]];
      site = this->Parents[site];
    }
    return site;
  }

private:
  /// Maximum number of points at one position, and of cells at one edge, that
  /// are compared.
  static constexpr std::size_t MaximumNeighbors = 8;

  void Connect(std::uint32_t a, std::uint32_t b)
  {
    if (a == None || b == None || a == b ||
      !(glm::dot(this->Mesh.Sites[a].Normal, this->Mesh.Sites[b].Normal) > PatchCosine))
    {
      return;
    }
    const std::uint32_t rootA = this->Find(a);
    const std::uint32_t rootB = this->Find(b);
    this->Parents[std::max(rootA, rootB)] = std::min(rootA, rootB);
  }

  /// Returns the indices of all positions, equal ones next to each other.
  std::vector<std::uint32_t> SortPositions() const
  {
    const std::vector<glm::vec3>& positions = this->Own.Positions;
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](const std::uint32_t& i) {
      return std::tie(positions[i].x, positions[i].y, positions[i].z, i);
    };
    std::sort(order.begin(), order.end(),
      [&](const std::uint32_t& a, const std::uint32_t& b) { return key(a) < key(b); });
    return order;
  }

  /// Returns, for each position, the first of the equal ones.
  std::vector<std::uint32_t> FindFirsts() const
  {
    const std::vector<std::uint32_t> order = this->SortPositions();
    std::vector<std::uint32_t> firsts(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      const bool isCopy =
        i > 0 && this->Own.Positions[order[i]] == this->Own.Positions[order[i - 1]];
      firsts[order[i]] = isCopy ? firsts[order[i - 1]] : order[i];
    }
    return firsts;
  }

  const BakeInput& Mesh;
  const Surface& Own; ///< the polygons of the query points
  std::vector<std::uint32_t> Parents;
};

}

void LabelPatches(BakeInput& mesh)
{
  if (mesh.GetNumberOfCornerLists() == 0)
  {
    return;
  }
  PatchLabels labels(mesh);
  if (mesh.Corners.size() == mesh.GetNumberOfCornerLists())
  {
    labels.ConnectPoints();
  }
  else
  {
    labels.ConnectCells();
  }
  for (std::uint32_t i = 0; i < mesh.GetNumberOfCornerLists(); ++i)
  {
    mesh.Sites[i].Patch = labels.Find(i);
  }
}

}
