// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "InstanceGeometry.h"

#include "CoincidentSurfaces.h"
#include "Surface.h"
#include "SurfaceGeometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra
{

namespace
{

/// Relative enlargement of the sphere around an instance, for rounding errors.
constexpr double SphereSlack = 1e-6;
/// Relative extension of the range of a ray, so that of two hits at the same distance, the
/// same one is found in any order.
constexpr double RangeSlack = 1e-6;

void ComputeBounds(const RTCBoundsFunctionArguments* args)
{
  const TracedSurface& traced = GetTraced(args->geometryUserPtr);
  const AxisAlignedBox box = traced.Data->Instances->GetBox(args->primID);
  *args->bounds_o = { box.Low.x, box.Low.y, box.Low.z, 0.f, box.High.x, box.High.y, box.High.z,
    0.f };
}

/// A ray in the coordinates of an instance. It starts near the instance, which keeps the precision
/// of instances that are small compared to their distance.
struct LocalRay
{
  double Start = 0.0; ///< distance along the ray of its origin here
  float Length = 0.f; ///< of the direction in scene coordinates

  /// Converts the ray i of a packet to `to`. Returns false if it misses the sphere around the
  /// instance. `isExtended`: its range is extended by RangeSlack.
  bool Convert(const SurfaceInstances& instances, const InstanceFrame& frame, const RTCRayN* rays,
    unsigned int size, unsigned int i, bool isExtended, RTCRay& to)
  {
    auto* const from = const_cast<RTCRayN*>(rays); // Embree's accessors return references
    const glm::dvec3 origin = frame.ConvertPoint(
      { RTCRayN_org_x(from, size, i), RTCRayN_org_y(from, size, i), RTCRayN_org_z(from, size, i) });
    const glm::vec3 direction(
      RTCRayN_dir_x(from, size, i), RTCRayN_dir_y(from, size, i), RTCRayN_dir_z(from, size, i));
    const glm::dvec3 local = frame.Linear * glm::dvec3(direction);
    const double square = glm::dot(local, local);
    const glm::dvec3 toCenter = instances.Center - origin;
    const double middle = glm::dot(toCenter, local) / square;
    const glm::dvec3 closest = toCenter - middle * local;
    const double radius = instances.Radius * (1.0 + SphereSlack);
    const double rest = radius * radius - glm::dot(closest, closest);
    const double half = std::sqrt(rest / square); // NaN if the line misses the sphere
    this->Start = std::max<double>(RTCRayN_tnear(from, size, i), middle - half);
    const double end = static_cast<double>(RTCRayN_tfar(from, size, i));
    if (!(this->Start <= std::min(end, middle + half)))
    {
      return false;
    }
    this->Length = glm::length(direction);
    const glm::dvec3 start = origin + this->Start * local;
    to.org_x = static_cast<float>(start.x);
    to.org_y = static_cast<float>(start.y);
    to.org_z = static_cast<float>(start.z);
    to.tnear = 0.f;
    to.dir_x = static_cast<float>(local.x);
    to.dir_y = static_cast<float>(local.y);
    to.dir_z = static_cast<float>(local.z);
    to.time = 0.f;
    to.tfar = static_cast<float>((end - this->Start) + (isExtended ? RangeSlack * end : 0.0));
    to.mask = 0xffffffffu;
    to.id = RTCRayN_id(from, size, i);
    to.flags = 0;
    return true;
  }
};

/// Embree callback: nearest hit. Of equally distant hits, that of the last surface is kept, as of round shapes, and of
/// one surface that of the first instance, so that the result does not depend on the order of the traversal.
void Intersect(const RTCIntersectFunctionNArguments* args)
{
  const TracedSurface& traced = GetTraced(args->geometryUserPtr);
  const SurfaceInstances& instances = *traced.Data->Instances;
  RTCRayN* const rays = RTCRayHitN_RayN(args->rayhit, args->N);
  RTCHitN* const hits = RTCRayHitN_HitN(args->rayhit, args->N);
  const unsigned int size = args->N;
  const InstanceFrame frame(instances, args->primID);
  InstanceQuery instance;
  instance.First = args->primID * static_cast<std::uint32_t>(traced.Data->Triangles.size());
  instance.Surface = args->geomID;
  instance.IsMirrored = glm::determinant(frame.Linear) < 0.0;
  Query query(false, static_cast<QueryContext*>(args->context)->Candidates);
  query.Context.Instance = &instance;
  for (unsigned int i = 0; i < size; ++i)
  {
    LocalRay local;
    RTCRayHit inner;
    if (args->valid[i] == 0 || !local.Convert(instances, frame, rays, size, i, true, inner.ray))
    {
      continue;
    }
    instance.Start = local.Start;
    instance.Length = local.Length;
    inner.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    inner.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    query.Intersect(traced.Shape, inner);
    if (inner.hit.geomID == RTC_INVALID_GEOMETRY_ID)
    {
      continue;
    }
    const float farthest = RTCRayN_tfar(rays, size, i);
    auto distance = static_cast<float>(local.Start + static_cast<double>(inner.ray.tfar));
    if (traced.DepthTolerance > 0.f)
    {
      distance = std::min(distance, farthest); // it is the range that the filter has set
    }
    const std::uint32_t primitive = instance.First + inner.hit.primID;
    const unsigned int geometry = RTCHitN_geomID(hits, size, i);
    if (distance > farthest ||
      (distance == farthest && geometry != RTC_INVALID_GEOMETRY_ID &&
        (geometry > args->geomID ||
          (geometry == args->geomID && RTCHitN_primID(hits, size, i) < primitive))))
    {
      continue;
    }
    RTCRayN_tfar(rays, size, i) = distance;
    RTCHitN_u(hits, size, i) = inner.hit.u;
    RTCHitN_v(hits, size, i) = inner.hit.v;
    RTCHitN_geomID(hits, size, i) = args->geomID;
    RTCHitN_primID(hits, size, i) = primitive;
    RTCHitN_instID(hits, size, i, 0) = RTC_INVALID_GEOMETRY_ID;
  }
}

/// Embree callback: occlusion.
void Occlude(const RTCOccludedFunctionNArguments* args)
{
  const TracedSurface& traced = GetTraced(args->geometryUserPtr);
  const SurfaceInstances& instances = *traced.Data->Instances;
  const InstanceFrame frame(instances, args->primID);
  Query query(false);
  for (unsigned int i = 0; i < args->N; ++i)
  {
    LocalRay local;
    RTCRay inner;
    if (args->valid[i] != 0 && local.Convert(instances, frame, args->ray, args->N, i, false, inner))
    {
      query.Occluded(traced.Shape, inner);
      if (inner.tfar < 0.f)
      {
        RTCRayN_tfar(args->ray, args->N, i) = -std::numeric_limits<float>::infinity();
      }
    }
  }
}

}

RTCGeometry MakeInstanceGeometry(RTCDevice device, TracedSurface& traced)
{
  return MakeUserGeometry(
    device, traced, traced.Data->Instances->GetCount(), { ComputeBounds, Intersect, Occlude });
}

}
