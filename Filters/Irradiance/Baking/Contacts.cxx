// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Contacts.h"

#include "Embree/RayScene.h"
#include "Gathering/IrradianceConstants.h"
#include "Shading/HemisphereSampling.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <unordered_map>

namespace penumbra
{
namespace
{

/// The part of a triangle that is between two directions at a corner, the query point.
struct Wedge
{
  glm::vec3 First; ///< unit
  glm::vec3 Second;
  glm::vec3 Normal; ///< unit
  float Length;     ///< of the bisector within the triangle

  float ComputeAngle() const
  {
    return std::atan2(
      glm::length(glm::cross(this->First, this->Second)), glm::dot(this->First, this->Second));
  }
};

/// Appends the wedge between the sides from `at` to `first` and to `second`, if it has an area.
void AddWedge(glm::vec3 at, glm::vec3 first, glm::vec3 second, std::vector<Wedge>& wedges)
{
  const glm::dvec3 a = glm::dvec3(first) - glm::dvec3(at);
  const glm::dvec3 b = glm::dvec3(second) - glm::dvec3(at);
  const double lengthA = glm::length(a);
  const double lengthB = glm::length(b);
  const glm::dvec3 normal = glm::cross(a, b);
  const double area = glm::length(normal);
  if (!(area > 0.0 && std::isfinite(lengthA + lengthB)))
  {
    return;
  }
  const double angle = std::atan2(area, glm::dot(a, b));
  const double bisector = 2.0 * lengthA * lengthB * std::cos(.5 * angle) / (lengthA + lengthB);
  wedges.push_back({ glm::vec3(a / lengthA), glm::vec3(b / lengthB), glm::vec3(normal / area),
    static_cast<float>(bisector) });
}

/// Splits the wedges that a plane through the query point cuts.
void Cut(glm::vec3 plane, std::vector<Wedge>& wedges)
{
  const std::size_t count = wedges.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    const Wedge whole = wedges[i];
    const float first = glm::dot(plane, whole.First);
    const float second = glm::dot(plane, whole.Second);
    if (std::min(first, second) < -MinimumContactSine &&
      std::max(first, second) > MinimumContactSine)
    {
      const glm::vec3 between = glm::normalize(second * whole.First - first * whole.Second);
      const glm::vec3 cut = second > first ? between : -between;
      wedges[i].Second = cut;
      wedges.push_back(whole);
      wedges.back().First = cut;
    }
  }
}

float GetSpacing(const RecordCandidate& site)
{
  return site.Pixel / PixelPerSpacing;
}

/// Returns the distance by which a query point is moved. It exceeds the height of ray origins, so
/// that these stay inside of concave edges.
float ComputeContactOffset(const RecordCandidate& site)
{
  return std::max(
    ContactOffset * GetSpacing(site), ContactOffsetPerRayOffset * RayOriginOffset(site.Position));
}

class ContactSeparation
{
public:
  ContactSeparation(const RayScene& rays, BakeInput& mesh)
    : Rays(rays),
      Mesh(mesh),
      Own(mesh.OccluderScene.Surfaces.front())
  {
  }

  void Run(const ProgressCallback& progress)
  {
    const std::vector<std::uint32_t> touched = this->FindTouched(progress);
    if (touched.empty())
    {
      return;
    }
    this->CollectWedges(touched);
    std::vector<std::vector<SitePart>> parts(touched.size());
    if (!ParallelForWithProgress(static_cast<int>(touched.size()), 0.0, 0.0, progress,
          [&](int i) { parts[i] = this->Divide(touched[i], this->Wedges[i]); }))
    {
      throw Stopped();
    }
    this->Replace(touched, parts);
  }

private:
  struct SitePart
  {
    RecordCandidate Site;
    float Weight;
  };

  bool IsOwn(std::uint32_t surface, std::uint32_t triangle, std::size_t site) const
  {
    if (surface != 0)
    {
      return false;
    }
    const glm::uvec3 corners = this->Own.Triangles[triangle];
    const auto [first, last] = this->Mesh.GetCorners(site);
    const auto count =
      std::count_if(&corners.x, &corners.x + 3, [first = first, last = last](std::uint32_t corner) {
        return std::find(first, last, corner) != last;
      });
    // A query point is a corner of its triangles, or they have three corners of its cell.
    return count >= (last - first == 1 ? 1 : 3);
  }

  /// Calls visit(normal) with the unit normals of other triangles that touch a query point, except
  /// parallel ones, until it returns true.
  template <typename Visit>
  void VisitTouching(std::size_t site, const Visit& visit) const
  {
    const RecordCandidate& at = this->Mesh.Sites[site];
    int visited = 0;
    VisitTrianglesNear(this->Rays, at.Position,
      ContactDistancePerRayOffset * RayOriginOffset(at.Position),
      [&](std::uint32_t surface, std::uint32_t triangle) {
        if (this->IsOwn(surface, triangle, site))
        {
          return false;
        }
        const Surface& other = this->Mesh.OccluderScene.Surfaces[surface];
        const glm::vec3 normal = other.ComputeNormal(triangle);
        const float length = glm::length(normal);
        const bool isParallel =
          std::abs(glm::dot(normal, at.Normal)) >= ContactParallelCosine * length;
        return ++visited >= MaximumContacts ||
          (length > 0.f && !isParallel && visit(normal / length));
      });
  }

  std::vector<std::uint32_t> FindTouched(const ProgressCallback& progress) const
  {
    const std::size_t count = this->Mesh.GetNumberOfCornerLists();
    std::vector<char> isTouched(count, 0);
    if (!ParallelForWithProgress(static_cast<int>(count), 0.0, 0.0, progress, [&](int i) {
          isTouched[i] = this->Mesh.Sites[i].Normal == glm::vec3(0.f);
          this->VisitTouching(i, [&](glm::vec3) {
            isTouched[i] = 1;
            return true;
          });
        }))
    {
      throw Stopped();
    }
    std::vector<std::uint32_t> touched;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (isTouched[i])
      {
        touched.push_back(static_cast<std::uint32_t>(i));
      }
    }
    return touched;
  }

  void CollectWedges(const std::vector<std::uint32_t>& touched)
  {
    this->Wedges.resize(touched.size());
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> vertices;
    for (std::uint32_t i = 0; i < touched.size(); ++i)
    {
      const auto [first, last] = this->Mesh.GetCorners(touched[i]);
      if (last - first == 1)
      {
        vertices[*first].push_back(i);
        continue;
      }
      for (const std::uint32_t* corner = first; corner < last; ++corner)
      {
        const std::uint32_t next = corner + 1 == last ? *first : corner[1];
        AddWedge(this->Mesh.Sites[touched[i]].Position, this->Own.Positions[*corner],
          this->Own.Positions[next], this->Wedges[i]);
      }
    }
    for (const glm::uvec3& corners : this->Own.Triangles)
    {
      for (int k = 0; k < 3 && !vertices.empty(); ++k)
      {
        const auto found = vertices.find(corners[k]);
        for (std::size_t i = 0; found != vertices.end() && i < found->second.size(); ++i)
        {
          AddWedge(this->Own.Positions[corners[k]], this->Own.Positions[corners[(k + 1) % 3]],
            this->Own.Positions[corners[(k + 2) % 3]], this->Wedges[found->second[i]]);
        }
      }
    }
  }

  /// Returns the query point moved by `offset` along a unit vector in the plane of `normal`.
  static RecordCandidate Move(
    const RecordCandidate& site, glm::vec3 direction, float offset, glm::vec3 normal)
  {
    RecordCandidate moved = site;
    moved.Position += offset * direction;
    if (site.Normal == glm::vec3(0.f))
    {
      moved.Normal = normal;
      return moved;
    }
    const float cosine = glm::dot(normal, site.Normal);
    if (std::abs(cosine) < FlatCosine)
    {
      // Normals of points decide on the side, because polygons may face either way.
      moved.GeometricNormal = cosine < 0.f ? -normal : normal;
    }
    return moved;
  }

  /// Returns the planes of the triangles that touch a query point, without those that continue one
  /// of its wedges.
  std::vector<glm::vec3> FindPlanes(std::size_t index, const std::vector<Wedge>& wedges) const
  {
    std::vector<glm::vec3> normals;
    this->VisitTouching(index, [&](glm::vec3 normal) {
      normals.push_back(normal);
      return false;
    });
    // The order of the visits depends on the BVH, and so on triangles elsewhere.
    std::sort(normals.begin(), normals.end(),
      [](glm::vec3 a, glm::vec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
    std::vector<glm::vec3> planes;
    for (std::size_t i = 0; i < normals.size() && planes.size() < MaximumContactPlanes; ++i)
    {
      const glm::vec3 normal = normals[i];
      const bool continues = std::any_of(wedges.begin(), wedges.end(),
        [&](const Wedge& wedge) { return glm::dot(wedge.Normal, normal) > ContactParallelCosine; });
      const bool isKnown = std::any_of(planes.begin(), planes.end(),
        [&](glm::vec3 plane) { return std::abs(glm::dot(plane, normal)) > FlatCosine; });
      if (!continues && !isKnown)
      {
        planes.push_back(normal);
      }
    }
    return planes;
  }

  /// Wedges in one plane and on the same side of all touching polygons.
  struct Region
  {
    std::vector<bool> Sides;
    std::vector<Wedge> Wedges;
    glm::vec3 Direction{ 0.f }; ///< sum of the bisectors, weighted by the angles
    float Angle = 0.f;
    float Length = std::numeric_limits<float>::infinity();

    void Add(const Wedge& wedge)
    {
      const float angle = wedge.ComputeAngle();
      this->Wedges.push_back(wedge);
      this->Direction += angle * glm::normalize(wedge.First + wedge.Second);
      this->Angle += angle;
      this->Length = std::min(this->Length, wedge.Length);
    }
  };

  static std::vector<Region> FindRegions(
    const std::vector<glm::vec3>& planes, const std::vector<Wedge>& wedges)
  {
    std::vector<Region> regions;
    for (const Wedge& wedge : wedges)
    {
      std::vector<bool> sides;
      for (const glm::vec3 plane : planes)
      {
        sides.push_back(glm::dot(plane, wedge.First + wedge.Second) > 0.f);
      }
      const auto found = std::find_if(regions.begin(), regions.end(), [&](const Region& region) {
        return region.Sides == sides &&
          glm::dot(region.Wedges.front().Normal, wedge.Normal) > FlatCosine;
      });
      Region& region = found == regions.end() ? regions.emplace_back() : *found;
      region.Sides = sides;
      region.Add(wedge);
    }
    return regions;
  }

  std::vector<SitePart> Divide(std::size_t index, std::vector<Wedge>& wedges) const
  {
    const RecordCandidate& site = this->Mesh.Sites[index];
    const float offset = ComputeContactOffset(site);
    const std::vector<glm::vec3> planes = this->FindPlanes(index, wedges);
    if (planes.empty() && site.Normal != glm::vec3(0.f))
    {
      return { { site, 1.f } };
    }
    for (const glm::vec3 plane : planes)
    {
      Cut(plane, wedges);
    }
    std::vector<SitePart> parts;
    const auto add = [&](const Region& region) {
      parts.push_back(
        { Move(site, glm::normalize(region.Direction),
            std::min(offset, MaximumContactFraction * region.Length), region.Wedges.front().Normal),
          region.Angle });
    };
    for (const Region& region : FindRegions(planes, wedges))
    {
      if (glm::length(region.Direction) >= MinimumContactBisector * region.Angle)
      {
        add(region);
        continue;
      }
      for (const Wedge& wedge : region.Wedges) // they surround the point
      {
        Region single;
        single.Add(wedge);
        add(single);
      }
    }
    if (parts.empty() && site.Normal == glm::vec3(0.f))
    {
      RecordCandidate unused = site;
      unused.Normal = glm::vec3(0.f, 0.f, 1.f);
      return { { unused, 0.f } };
    }
    if (parts.empty())
    {
      return { { site, 1.f } };
    }
    const auto larger = [](const SitePart& a, const SitePart& b) { return a.Weight > b.Weight; };
    std::stable_sort(parts.begin(), parts.end(), larger);
    parts.resize(std::min(parts.size(), MaximumContactParts));
    float sum = 0.f;
    for (const SitePart& part : parts)
    {
      sum += part.Weight;
    }
    for (SitePart& part : parts)
    {
      part.Weight /= sum;
    }
    return parts;
  }

  /// Replaces touched query points by their parts. The first part keeps the index.
  void Replace(
    const std::vector<std::uint32_t>& touched, const std::vector<std::vector<SitePart>>& parts)
  {
    BakeInput& mesh = this->Mesh;
    mesh.Weights.resize(mesh.Sites.size(), 1.f); // strips have weights
    for (std::size_t i = 0; i < touched.size(); ++i)
    {
      const float weight = mesh.Weights[touched[i]];
      for (std::size_t k = 0; k < parts[i].size(); ++k)
      {
        const SitePart& part = parts[i][k];
        if (k == 0)
        {
          mesh.Sites[touched[i]] = part.Site;
          mesh.Weights[touched[i]] = weight * part.Weight;
          continue;
        }
        mesh.Sites.push_back(part.Site);
        mesh.Weights.push_back(weight * part.Weight);
        mesh.Ids.push_back(mesh.Ids[touched[i]]);
      }
    }
  }

  const RayScene& Rays;
  BakeInput& Mesh;
  const Surface& Own; ///< the polygons of the query points
  std::vector<std::vector<Wedge>> Wedges;
};

}

void SeparateContacts(const RayScene& rays, BakeInput& mesh, const ProgressCallback& progress)
{
  if (mesh.GetNumberOfCornerLists() > 0)
  {
    ContactSeparation(rays, mesh).Run(progress);
  }
}

}
