// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionClipping.h"

#include "SceneCoordinates.h"
#include "Surface.h"

#include <map>
#include <utility>

namespace penumbra
{
namespace
{

/// Clips the triangles of one surface by one plane.
class PlaneClipper
{
public:
  PlaneClipper(Surface& surface, glm::dvec4 plane)
    : Target(surface)
  {
    this->Distances.reserve(surface.Positions.size());
    for (const glm::vec3& x : surface.Positions)
    {
      this->Distances.push_back(glm::dot(glm::dvec3(plane), glm::dvec3(x)) + plane.w);
    }
  }

  void Clip()
  {
    const std::vector<glm::uvec3> triangles = std::move(this->Target.Triangles);
    this->Target.Triangles.clear();
    this->Target.Triangles.reserve(triangles.size() + 1);
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
      this->Add(triangles[i], static_cast<std::uint32_t>(i));
    }
    this->Target.Triangles.reserve(this->Target.Triangles.size() + 1);
    this->Target.Positions.reserve(this->Target.Positions.size() + 1);
    this->CopyTriangleValues(triangles.size());
  }

private:
  bool IsKept(std::uint32_t i) const { return this->Distances[i] >= 0.0; }

  void Add(glm::uvec3 triangle, std::uint32_t source)
  {
    // The part of the triangle in front of the plane is a polygon with up to four corners.
    std::uint32_t corners[4];
    int count = 0;
    for (int k = 0; k < 3; ++k)
    {
      const std::uint32_t current = triangle[k];
      const std::uint32_t next = triangle[(k + 1) % 3];
      if (this->IsKept(current))
      {
        corners[count++] = current;
      }
      if (this->IsKept(current) != this->IsKept(next))
      {
        corners[count++] = this->IntersectEdge(current, next);
      }
    }
    for (int k = 2; k < count; ++k)
    {
      const glm::dvec3 a = this->Target.Positions[corners[0]];
      const glm::dvec3 b = this->Target.Positions[corners[k - 1]];
      const glm::dvec3 c = this->Target.Positions[corners[k]];
      if (glm::cross(b - a, c - a) != glm::dvec3(0.0))
      {
        this->Target.Triangles.emplace_back(corners[0], corners[k - 1], corners[k]);
        this->Sources.push_back(source);
      }
    }
  }

  /// Returns the index of the intersection of edge (i, j) with the plane. Both triangles of the
  /// edge use the same point.
  std::uint32_t IntersectEdge(std::uint32_t i, std::uint32_t j)
  {
    if (j < i)
    {
      std::swap(i, j);
    }
    const auto existing = this->EdgePoints.find({ i, j });
    if (existing != this->EdgePoints.end())
    {
      return existing->second;
    }
    const double t = this->Distances[i] / (this->Distances[i] - this->Distances[j]);
    const auto index = static_cast<std::uint32_t>(this->Target.Positions.size());
    const auto interpolate = [&](auto& values) {
      if (!values.empty())
      {
        using Value = typename std::decay<decltype(values)>::type::value_type;
        const Value value = Interpolate(values[i], values[j], t);
        values.push_back(value);
      }
    };
    interpolate(this->Target.Positions);
    interpolate(this->Target.Normals);
    interpolate(this->Target.Tangents);
    interpolate(this->Target.PointColors);
    interpolate(this->Target.ColorCoordinates);
    interpolate(this->Target.TextureCoordinates);
    this->EdgePoints[{ i, j }] = index;
    return index;
  }

  static glm::vec3 Interpolate(glm::vec3 a, glm::vec3 b, double t)
  {
    return glm::mix(glm::dvec3(a), glm::dvec3(b), t);
  }
  static glm::vec2 Interpolate(glm::vec2 a, glm::vec2 b, double t)
  {
    return glm::mix(glm::dvec2(a), glm::dvec2(b), t);
  }
  static glm::u8vec4 Interpolate(glm::u8vec4 a, glm::u8vec4 b, double t)
  {
    return glm::mix(glm::dvec4(a), glm::dvec4(b), t) + 0.5;
  }

  /// Copies the values per triangle from the original triangles to the clipped ones.
  void CopyTriangleValues(std::size_t count)
  {
    if (this->Target.CellIds.empty() &&
      (this->Sources.size() != count || !this->EdgePoints.empty()))
    {
      this->Target.CellIds = this->Sources;
    }
    else
    {
      this->CopyFromSources(this->Target.CellIds);
    }
    this->CopyFromSources(this->Target.CellColors);
    this->CopyFromSources(this->Target.TriangleNormals);
  }

  template <typename T>
  void CopyFromSources(std::vector<T>& values) const
  {
    if (values.empty())
    {
      return;
    }
    std::vector<T> result;
    result.reserve(this->Sources.size());
    for (const std::uint32_t source : this->Sources)
    {
      result.push_back(values[source]);
    }
    values = std::move(result);
  }

  Surface& Target;
  std::vector<double> Distances;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> EdgePoints;
  std::vector<std::uint32_t> Sources;
};

}

glm::dvec4 ToScene(glm::dvec4 plane, const SceneCoordinates& coordinates)
{
  // world = Origin + x / Scale
  const glm::dvec3 normal(plane);
  return { normal, coordinates.Scale * (plane.w + glm::dot(normal, coordinates.Origin)) };
}

void ClipSurface(
  const std::vector<glm::dvec4>& planes, const SceneCoordinates& coordinates, Surface& surface)
{
  for (const glm::dvec4& plane : planes)
  {
    PlaneClipper(surface, ToScene(plane, coordinates)).Clip();
  }
}

}
