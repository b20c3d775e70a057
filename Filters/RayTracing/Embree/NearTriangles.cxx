// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EmbreeQuery.h"
#include "PlanarCells.h"
#include "RayScene.h"
#include "SliverTree.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace penumbra
{
namespace
{

/// Returns the squared distance between a point and a triangle.
double ComputeSquaredDistance(glm::dvec3 point, const glm::dvec3 (&corners)[3])
{
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double square = glm::dot(normal, normal);
  bool isInside = square > 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k)
  {
    const glm::dvec3 from = corners[k];
    const glm::dvec3 edge = corners[(k + 1) % 3] - from;
    const glm::dvec3 offset = point - from;
    isInside = isInside && glm::dot(glm::cross(normal, edge), offset) >= 0.0;
    const double length = glm::dot(edge, edge);
    const double at = length > 0.0 ? std::clamp(glm::dot(offset, edge) / length, 0.0, 1.0) : 0.0;
    const glm::dvec3 rest = offset - at * edge;
    nearest = std::min(nearest, glm::dot(rest, rest));
  }
  const double height = glm::dot(normal, point - corners[0]);
  return isInside ? height * height / square : nearest;
}

/// Returns the distance between a point and a sphere or the hull of a tube; 0 inside.
double ComputeDistance(glm::dvec3 point, const RoundShape& shape)
{
  const glm::dvec3 edge = glm::dvec3(shape.B) - glm::dvec3(shape.A);
  const glm::dvec3 offset = point - glm::dvec3(shape.A);
  const double length = glm::dot(edge, edge);
  const double at = length > 0.0 ? std::clamp(glm::dot(offset, edge) / length, 0.0, 1.0) : 0.0;
  return std::max(
    glm::length(offset - at * edge) - std::max<double>(shape.RadiusA, shape.RadiusB), 0.0);
}

struct NearQuery
{
  const RayScene& Rays;
  glm::dvec3 Point;
  /// Called with each primitive within the radius; reduces it.
  std::function<void(NearQuery&, std::uint32_t, std::uint32_t)> Test;
  bool IncludesRound;
  double Radius;

  double ComputeDistance(std::uint32_t index, std::uint32_t primitive) const
  {
    const Surface& surface = this->Rays.GetSurfaces()[index];
    if (surface.IsRound())
    {
      return penumbra::ComputeDistance(this->Point, surface.GetRoundShape(primitive));
    }
    glm::dvec3 corners[3];
    for (int k = 0; k < 3; ++k)
    {
      corners[k] = glm::dvec3(surface.Positions[surface.Triangles[primitive][k]]);
    }
    return std::sqrt(ComputeSquaredDistance(this->Point, corners));
  }

  /// Returns true if nothing is left to find.
  bool IsDone() const { return this->Radius < 0.0; }

  void Run()
  {
    // Slightly larger, because the bounds of primitives are in single precision.
    RTCPointQuery query{ static_cast<float>(this->Point.x), static_cast<float>(this->Point.y),
      static_cast<float>(this->Point.z), 0.f, GetQueryRadius(this->Radius) };
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(this->Rays.GetTree(), &query, &context, NearQuery::Callback, this);
  }

private:
  static float GetQueryRadius(double radius)
  {
    return static_cast<float>(1.000001 * std::max(radius, 0.0));
  }

  /// Called by Embree for each primitive whose box is near the point.
  static bool Callback(RTCPointQueryFunctionArguments* args)
  {
    NearQuery& self = *static_cast<NearQuery*>(args->userPtr);
    const bool isRound = self.Rays.GetSurfaces()[args->geomID].IsRound();
    if (args->context->instStackSize > 0 || (isRound && !self.IncludesRound) || self.IsDone())
    {
      return false;
    }
    const double before = self.Radius;
    const auto test = [&](std::uint32_t primitive) {
      if (!self.IsDone())
      {
        self.Test(self, args->geomID, primitive);
      }
      return self.IsDone();
    };
    if (const SliverTree* slivers = self.Rays.GetSlivers(args->geomID))
    {
      slivers->VisitNear(self.Point, GetQueryRadius(before), test);
    }
    else if (const PlanarCells* cells = self.Rays.GetCells(args->geomID))
    {
      cells->VisitTriangles(args->primID, test);
    }
    else
    {
      test(args->primID);
    }
    if (self.Radius < before)
    {
      args->query->radius = GetQueryRadius(self.Radius);
    }
    return self.Radius < before;
  }
};

}

void VisitTrianglesNear(const RayScene& rays, glm::vec3 point, float radius,
  const std::function<bool(std::uint32_t, std::uint32_t)>& visit)
{
  NearQuery near{ rays, glm::dvec3(point),
    [&](NearQuery& query, std::uint32_t surface, std::uint32_t triangle) {
      if (query.ComputeDistance(surface, triangle) <= query.Radius && visit(surface, triangle))
      {
        query.Radius = -1.0;
      }
    },
    false, radius };
  near.Run();
}

float FindNearest(const RayScene& rays, glm::vec3 point, float radius,
  const std::function<bool(std::uint32_t, std::uint32_t)>& accept)
{
  bool isFound = false;
  NearQuery near{ rays, glm::dvec3(point),
    [&](NearQuery& query, std::uint32_t surface, std::uint32_t primitive) {
      const bool isAccepted = accept(surface, primitive);
      const double distance = isAccepted ? query.ComputeDistance(surface, primitive) : 0.0;
      if (isAccepted && distance <= query.Radius)
      {
        query.Radius = distance;
        isFound = true;
      }
    },
    true, radius };
  near.Run();
  return isFound ? static_cast<float>(near.Radius) : std::numeric_limits<float>::infinity();
}

}
