// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Obstacles.h"

#include "Embree/RayScene.h"
#include "Gathering/IrradianceConstants.h"
#include "Shading/HemisphereSampling.h"
#include "Surface.h"

#include <algorithm>
#include <limits>

namespace penumbra
{
namespace
{

constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

/// Returns the greatest height of a primitive above the tangent plane of a query point.
float ComputeHeight(const Surface& surface, std::uint32_t primitive, const RecordCandidate& site)
{
  const auto height = [&](glm::vec3 at) { return glm::dot(at - site.Position, site.Normal); };
  if (surface.IsRound())
  {
    const RoundShape shape = surface.GetRoundShape(primitive);
    return std::max(height(shape.A) + shape.RadiusA, height(shape.B) + shape.RadiusB);
  }
  const auto [a, b, c] = surface.GetPoints(primitive);
  return std::max({ height(a), height(b), height(c) });
}

/// Returns true if the plane of a triangle that faces a query point passes through it.
bool FacesContact(
  const Surface& surface, std::uint32_t primitive, const RecordCandidate& site, float height)
{
  if (surface.IsRound())
  {
    return false;
  }
  const glm::vec3 area = surface.ComputeNormal(primitive);
  const glm::vec3 a = surface.GetPoints(primitive)[0];
  const float length = glm::length(area);
  return glm::dot(area, site.Normal) < -FlatCosine * length &&
    std::abs(glm::dot(area, a - site.Position)) <= height * length;
}

}

Obstacles::Obstacles(const BakeInput& mesh, const RayScene& rays)
  : Mesh(mesh),
    Rays(rays),
    TriangleSites(mesh.OccluderScene.Surfaces.front().Triangles.size(), glm::uvec3(None))
{
  if (mesh.Corners.size() == mesh.GetNumberOfCornerLists())
  {
    this->FindSitesOfPoints();
  }
  else
  {
    this->FindSitesOfCells();
  }
}

void Obstacles::FindSitesOfPoints()
{
  const Surface& own = this->Mesh.OccluderScene.Surfaces.front();
  std::vector<std::uint32_t> sites(own.Positions.size(), None);
  for (std::uint32_t site = 0; site < this->Mesh.Corners.size(); ++site)
  {
    sites[this->Mesh.Corners[site]] = site;
  }
  for (std::size_t i = 0; i < own.Triangles.size(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      this->TriangleSites[i][k] = sites[own.Triangles[i][k]];
    }
  }
}

void Obstacles::FindSitesOfCells()
{
  const Surface& own = this->Mesh.OccluderScene.Surfaces.front();
  const auto count = static_cast<std::uint32_t>(this->Mesh.GetNumberOfCornerLists());
  std::vector<std::size_t> ends(own.Positions.size() + 1, 0); // of the cells of each position
  for (const std::uint32_t corner : this->Mesh.Corners)
  {
    ++ends[corner + 1];
  }
  for (std::size_t i = 1; i < ends.size(); ++i)
  {
    ends[i] += ends[i - 1];
  }
  std::vector<std::size_t> next(ends.begin(), ends.end() - 1);
  std::vector<std::uint32_t> cells(this->Mesh.Corners.size());
  for (std::uint32_t site = 0; site < count; ++site)
  {
    const auto [first, last] = this->Mesh.GetCorners(site);
    std::for_each(first, last, [&](std::uint32_t corner) { cells[next[corner]++] = site; });
  }
  for (std::size_t i = 0; i < own.Triangles.size(); ++i)
  {
    const glm::uvec3 corners = own.Triangles[i];
    const auto size = [&](int k) { return ends[corners[k] + 1] - ends[corners[k]]; };
    const int fewest = size(0) <= size(1) ? (size(0) <= size(2) ? 0 : 2)
      : size(1) <= size(2)                ? 1
                                          : 2;
    for (std::size_t at = ends[corners[fewest]]; at < ends[corners[fewest] + 1]; ++at)
    {
      const auto [first, last] = this->Mesh.GetCorners(cells[at]);
      const bool hasAll =
        std::all_of(&corners.x, &corners.x + 3, [first = first, last = last](std::uint32_t corner) {
          return std::find(first, last, corner) != last;
        });
      if (hasAll)
      {
        this->TriangleSites[i] = glm::uvec3(cells[at]);
        break;
      }
    }
  }
}

bool Obstacles::IsObstacle(
  const RecordCandidate& site, float height, std::uint32_t surface, std::uint32_t primitive) const
{
  if (surface == 0)
  {
    if (this->Mesh.GetNumberOfCornerLists() == 0)
    {
      return false; // disks of the query points
    }
    const glm::uvec3 sites = this->TriangleSites[primitive];
    for (int k = 0; k < 3; ++k)
    {
      if (sites[k] == None)
      {
        continue;
      }
      const RecordCandidate& other = this->Mesh.Sites[sites[k]];
      if (other.Patch == site.Patch && glm::dot(other.Normal, site.Normal) > ObstacleCosine)
      {
        return false;
      }
    }
  }
  const Surface& other = this->Rays.GetSurfaces()[surface];
  return ComputeHeight(other, primitive, site) > height ||
    FacesContact(other, primitive, site, height);
}

float Obstacles::FindDistance(const RecordCandidate& site, float radius) const
{
  const float height = ObstacleHeightPerRayOffset * RayOriginOffset(site.Position);
  return FindNearest(
    this->Rays, site.Position, radius, [&](std::uint32_t surface, std::uint32_t primitive) {
      return this->IsObstacle(site, height, surface, primitive);
    });
}

}
