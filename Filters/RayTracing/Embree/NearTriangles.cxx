// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EmbreeQuery.h"
#include "PlanarCells.h"
#include "RayScene.h"
#include "Scene.h"
#include "SliverTree.h"
#include "Surface.h"

#include <algorithm>
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

struct NearQuery
{
  const RayScene& Rays;
  glm::vec3 Point;
  float Radius;
  const std::function<bool(std::uint32_t, std::uint32_t)>& Visit;
  bool IsDone = false;

  void Test(std::uint32_t index, std::uint32_t triangle)
  {
    const Surface& surface = this->Rays.GetScene().Surfaces[index];
    glm::dvec3 corners[3];
    for (int k = 0; k < 3; ++k)
    {
      corners[k] = glm::dvec3(surface.Positions[surface.Triangles[triangle][k]]);
    }
    const double square = static_cast<double>(this->Radius) * this->Radius;
    this->IsDone = this->IsDone ||
      (ComputeSquaredDistance(glm::dvec3(this->Point), corners) <= square &&
        this->Visit(index, triangle));
  }

  /// Called by Embree for each primitive whose box is near the point.
  static bool Callback(RTCPointQueryFunctionArguments* args)
  {
    NearQuery& self = *static_cast<NearQuery*>(args->userPtr);
    if (args->context->instStackSize > 0 || self.Rays.GetScene().Surfaces[args->geomID].IsRound())
    {
      return false;
    }
    if (const SliverTree* slivers = self.Rays.GetSlivers(args->geomID))
    {
      slivers->VisitNear(glm::dvec3(self.Point), self.Radius,
        [&](std::uint32_t triangle) { self.Test(args->geomID, triangle); });
    }
    else if (const PlanarCells* cells = self.Rays.GetCells(args->geomID))
    {
      cells->VisitTriangles(args->primID, [&](std::uint32_t triangle) {
        self.Test(args->geomID, triangle);
        return self.IsDone;
      });
    }
    else
    {
      self.Test(args->geomID, args->primID);
    }
    if (self.IsDone)
    {
      args->query->radius = 0.f;
    }
    return self.IsDone;
  }
};

}

void VisitTrianglesNear(const RayScene& rays, glm::vec3 point, float radius,
  const std::function<bool(std::uint32_t, std::uint32_t)>& visit)
{
  NearQuery near{ rays, point, radius, visit };
  RTCPointQuery query{ point.x, point.y, point.z, 0.f, radius };
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(rays.GetTree(), &query, &context, NearQuery::Callback, &near);
}

}
