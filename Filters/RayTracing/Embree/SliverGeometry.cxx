// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CoincidentSurfaces.h"
#include "PlanarCells.h"
#include "RayTriangle.h"
#include "SliverTree.h"
#include "Surface.h"
#include "SurfaceGeometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

namespace
{

/// Embree callback: bounds of the surface or of a cell, rounded outwards.
void ComputeBounds(const RTCBoundsFunctionArguments* args)
{
  constexpr float Infinity = std::numeric_limits<float>::infinity();
  if (const PlanarCells* cells = GetTraced(args->geometryUserPtr).Cells.get())
  {
    const AxisAlignedBox& box = cells->GetBox(args->primID);
    for (int axis = 0; axis < 3; ++axis)
    {
      (&args->bounds_o->lower_x)[axis] = box.Low[axis];
      (&args->bounds_o->upper_x)[axis] = box.High[axis];
    }
    return;
  }
  glm::vec3 low(Infinity);
  glm::vec3 high(-Infinity);
  const Surface& surface = *GetTraced(args->geometryUserPtr).Data;
  for (const glm::uvec3& triangle : surface.Triangles)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      low = glm::min(low, surface.Positions[triangle[corner]]);
      high = glm::max(high, surface.Positions[triangle[corner]]);
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    (&args->bounds_o->lower_x)[axis] = std::nextafter(low[axis], -Infinity);
    (&args->bounds_o->upper_x)[axis] = std::nextafter(high[axis], Infinity);
  }
}

Ray GetRay(RTCRayN* rays, unsigned int size, unsigned int i)
{
  Ray ray;
  ray.Origin = { RTCRayN_org_x(rays, size, i), RTCRayN_org_y(rays, size, i),
    RTCRayN_org_z(rays, size, i) };
  ray.Direction = { RTCRayN_dir_x(rays, size, i), RTCRayN_dir_y(rays, size, i),
    RTCRayN_dir_z(rays, size, i) };
  ray.Near = RTCRayN_tnear(rays, size, i);
  ray.Far = RTCRayN_tfar(rays, size, i);
  return ray;
}

bool IsInside(const glm::dvec3& point, const AxisAlignedBox& box)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(point[axis] >= box.Low[axis] && point[axis] <= box.High[axis]))
    {
      return false;
    }
  }
  return true;
}

/// Calls hit(triangle, distance) for the hits of a ray on a primitive; `hit` returns the distance up
/// to which further hits matter.
template <typename OnHit>
void ForEachHit(const TracedSurface& traced, std::uint32_t primitive, const Ray& ray, OnHit hit)
{
  const glm::dvec3 origin(ray.Origin);
  const glm::dvec3 direction(ray.Direction);
  double farthest = ray.Far;
  // Calls accept(distance) for a hit between the ends of the ray. Returns true if there is one.
  const auto test = [&](std::uint32_t triangle, const auto& accept) {
    const double distance = ComputeDistance(*traced.Data, triangle, origin, direction);
    const auto rounded = static_cast<float>(distance);
    const bool isHit = rounded > ray.Near && rounded <= farthest; // false for NaN
    if (isHit && accept(distance))
    {
      farthest = hit(triangle, rounded);
    }
    return isHit;
  };
  if (!traced.Cells)
  {
    traced.Slivers->VisitRay(origin, direction, ray.Near, farthest,
      [&](std::uint32_t triangle) { test(triangle, [](double) { return true; }); });
    return;
  }
  // Embree also passes rays of a packet that miss the box.
  const AxisAlignedBox& box = traced.Cells->GetBox(primitive);
  traced.Cells->VisitTriangles(primitive, [&](std::uint32_t triangle) {
    return test(
      triangle, [&](double distance) { return IsInside(origin + distance * direction, box); });
  });
}

/// Embree callback: nearest hit. Rejects hits on culled sides, and collects candidates for
/// CoincidentSurfaces.
void Intersect(const RTCIntersectFunctionNArguments* args)
{
  const TracedSurface& traced = GetTraced(args->geometryUserPtr);
  const Surface& surface = *traced.Data;
  RTCRayN* const rays = RTCRayHitN_RayN(args->rayhit, args->N);
  RTCHitN* const hits = RTCRayHitN_HitN(args->rayhit, args->N);
  for (unsigned int i = 0; i < args->N; ++i)
  {
    if (args->valid[i] == 0)
    {
      continue;
    }
    const Ray ray = GetRay(rays, args->N, i);
    const unsigned int id = RTCRayN_id(rays, args->N, i);
    ForEachHit(traced, args->primID, ray, [&](std::uint32_t triangle, float distance) -> double {
      float& farthest = RTCRayN_tfar(rays, args->N, i);
      const RayTriangle exact(surface, triangle, ray);
      if (!exact.IsValid || !(exact.IsFront ? surface.Frontfaces : surface.Backfaces))
      {
        return farthest;
      }
      const auto u = static_cast<float>(exact.U);
      const auto v = static_cast<float>(exact.V);
      farthest = distance;
      if (traced.DepthTolerance > 0.f)
      {
        const float tolerance = traced.DepthTolerance / glm::length(ray.Direction);
        CandidateHits& candidates = static_cast<QueryContext*>(args->context)->Candidates[id];
        farthest = std::min(candidates.Add({ args->geomID, triangle, u, v, distance }, tolerance,
                              traced.IsLastInFront) +
            tolerance,
          candidates.Far);
      }
      RTCHitN_u(hits, args->N, i) = u;
      RTCHitN_v(hits, args->N, i) = v;
      RTCHitN_geomID(hits, args->N, i) = args->geomID;
      RTCHitN_primID(hits, args->N, i) = triangle;
      RTCHitN_instID(hits, args->N, i, 0) = RTC_INVALID_GEOMETRY_ID;
      return farthest;
    });
  }
}

/// Embree callback: occlusion. Lines and points cast no shadows.
void Occlude(const RTCOccludedFunctionNArguments* args)
{
  const TracedSurface& traced = GetTraced(args->geometryUserPtr);
  for (unsigned int i = 0; i < args->N && !traced.Data->IsLineOrPoint; ++i)
  {
    if (args->valid[i] != 0)
    {
      ForEachHit(
        traced, args->primID, GetRay(args->ray, args->N, i), [&](std::uint32_t, float) -> double {
          RTCRayN_tfar(args->ray, args->N, i) = -std::numeric_limits<float>::infinity();
          return -1.0;
        });
    }
  }
}

}

RTCGeometry MakeSliverGeometry(RTCDevice device, TracedSurface& traced)
{
  return MakeUserGeometry(device, traced, traced.Cells ? traced.Cells->GetNumberOfCells() : 1,
    { ComputeBounds, Intersect, Occlude });
}

}
