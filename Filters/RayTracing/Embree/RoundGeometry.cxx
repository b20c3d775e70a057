// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RoundGeometry.h"

#include "RoundIntersection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

namespace
{

/// A point is inside a joined tube if it is deeper than this fraction of the radius.
constexpr double JointDepth = 1e-6;

const TracedSurface& GetTraced(const void* userData)
{
  return *static_cast<const TracedSurface*>(userData);
}

/// Embree callback: bounds of one shape, rounded outwards.
void ComputeBounds(const RTCBoundsFunctionArguments* args)
{
  const RoundShape shape = GetTraced(args->geometryUserPtr).Data->GetRoundShape(args->primID);
  constexpr float Infinity = std::numeric_limits<float>::infinity();
  float* const low = &args->bounds_o->lower_x;
  float* const high = &args->bounds_o->upper_x;
  for (int axis = 0; axis < 3; ++axis)
  {
    low[axis] = std::nextafter(
      std::min(shape.A[axis] - shape.RadiusA, shape.B[axis] - shape.RadiusB), -Infinity);
    high[axis] = std::nextafter(
      std::max(shape.A[axis] + shape.RadiusA, shape.B[axis] + shape.RadiusB), Infinity);
  }
}

/// Returns true if `point` is inside the tube that is joined to tube `primitive` at one of its
/// ends.
bool IsInsideJoinedTube(const Surface& surface, std::uint32_t primitive, glm::dvec3 point)
{
  const auto isInside = [&](std::uint32_t other) {
    const TouchingSphere sphere(surface.GetRoundShape(other), point);
    return glm::distance(point, sphere.Center) < (1.0 - JointDepth) * sphere.Radius;
  };
  const std::vector<glm::uvec2>& segments = surface.Segments;
  return (primitive > 0 && segments[primitive - 1].y == segments[primitive].x &&
           isInside(primitive - 1)) ||
    (primitive + 1 < segments.size() && segments[primitive + 1].x == segments[primitive].y &&
      isInside(primitive + 1));
}

/// A hit of one ray of a packet.
struct RoundHit
{
  float Distance = std::numeric_limits<float>::infinity();
  float U = 0.f;
};

/// Computes the hit of the ray i of a packet in the range of the ray. Returns false if there is
/// none.
bool FindHit(const TracedSurface& traced, std::uint32_t primitive, RTCRayN* rays, unsigned int size,
  unsigned int i, RoundHit& hit)
{
  const Surface& surface = *traced.Data;
  const glm::dvec3 origin(
    RTCRayN_org_x(rays, size, i), RTCRayN_org_y(rays, size, i), RTCRayN_org_z(rays, size, i));
  const glm::dvec3 direction(
    RTCRayN_dir_x(rays, size, i), RTCRayN_dir_y(rays, size, i), RTCRayN_dir_z(rays, size, i));
  const float nearest = RTCRayN_tnear(rays, size, i);
  const float farthest = RTCRayN_tfar(rays, size, i);
  const RoundShape shape = surface.GetRoundShape(primitive);
  const RoundIntersection range(shape, origin, direction);
  if (!range.IsHit)
  {
    return false;
  }
  const auto enter = static_cast<float>(range.Enter);
  const auto leave = static_cast<float>(range.Leave);
  double distance = range.Enter;
  if (enter < nearest || !surface.Frontfaces)
  {
    if (leave < nearest || !surface.Backfaces || (traced.IsTranslucent && range.Enter >= 0.0))
    {
      return false;
    }
    distance = range.Leave;
  }
  hit.Distance = static_cast<float>(distance);
  if (!(hit.Distance <= farthest))
  {
    return false;
  }
  const glm::dvec3 point = origin + distance * direction;
  if (traced.IsTranslucent && !surface.Segments.empty() &&
    IsInsideJoinedTube(surface, primitive, point))
  {
    return false;
  }
  hit.U = static_cast<float>(TouchingSphere(shape, point).U);
  return true;
}

/// Embree callback: nearest hit. Of equally distant shapes, the first one is hit, so that the
/// result does not depend on the order of the traversal.
void Intersect(const RTCIntersectFunctionNArguments* args)
{
  const TracedSurface& traced = GetTraced(args->geometryUserPtr);
  RTCRayN* const rays = RTCRayHitN_RayN(args->rayhit, args->N);
  RTCHitN* const hits = RTCRayHitN_HitN(args->rayhit, args->N);
  for (unsigned int i = 0; i < args->N; ++i)
  {
    RoundHit hit;
    if (args->valid[i] == 0 || !FindHit(traced, args->primID, rays, args->N, i, hit))
    {
      continue;
    }
    const unsigned int geometry = RTCHitN_geomID(hits, args->N, i);
    if (hit.Distance == RTCRayN_tfar(rays, args->N, i) && geometry != RTC_INVALID_GEOMETRY_ID &&
      (geometry < args->geomID ||
        (geometry == args->geomID && RTCHitN_primID(hits, args->N, i) < args->primID)))
    {
      continue;
    }
    RTCRayN_tfar(rays, args->N, i) = hit.Distance;
    RTCHitN_u(hits, args->N, i) = hit.U;
    RTCHitN_v(hits, args->N, i) = 0.f;
    RTCHitN_geomID(hits, args->N, i) = args->geomID;
    RTCHitN_primID(hits, args->N, i) = args->primID;
    RTCHitN_instID(hits, args->N, i, 0) = RTC_INVALID_GEOMETRY_ID;
  }
}

/// Embree callback: occlusion.
void Occlude(const RTCOccludedFunctionNArguments* args)
{
  const TracedSurface& traced = GetTraced(args->geometryUserPtr);
  for (unsigned int i = 0; i < args->N; ++i)
  {
    RoundHit hit;
    if (args->valid[i] != 0 && FindHit(traced, args->primID, args->ray, args->N, i, hit))
    {
      RTCRayN_tfar(args->ray, args->N, i) = -std::numeric_limits<float>::infinity();
    }
  }
}

}

RTCGeometry MakeRoundGeometry(RTCDevice device, TracedSurface& traced)
{
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(
    geometry, static_cast<unsigned int>(traced.Data->GetNumberOfPrimitives()));
  rtcSetGeometryUserData(geometry, &traced);
  rtcSetGeometryBoundsFunction(geometry, ComputeBounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, Intersect);
  rtcSetGeometryOccludedFunction(geometry, Occlude);
  rtcCommitGeometry(geometry);
  return geometry;
}

}
