// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceGeometry.h"

#include "BoxOverlap.h"
#include "CoincidentSurfaces.h"
#include "Surface.h"

#include <algorithm>
#include <new>

namespace penumbra
{

namespace
{

static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::uvec3) == 12, "Embree expects packed vectors");

/// Embree intersection filter: rejects hits on culled sides, collects candidates for
/// CoincidentSurfaces and extends the ray by the depth tolerance.
void IntersectFilter(const RTCFilterFunctionNArguments* args)
{
  const auto& traced = *static_cast<const TracedSurface*>(args->geometryUserPtr);
  const QueryContext& context = *static_cast<QueryContext*>(args->context);
  const InstanceQuery* instance = context.Instance;
  for (unsigned int i = 0; i < args->N; ++i)
  {
    const glm::vec3 direction(RTCRayN_dir_x(args->ray, args->N, i),
      RTCRayN_dir_y(args->ray, args->N, i), RTCRayN_dir_z(args->ray, args->N, i));
    const glm::vec3 normal(RTCHitN_Ng_x(args->hit, args->N, i), RTCHitN_Ng_y(args->hit, args->N, i),
      RTCHitN_Ng_z(args->hit, args->N, i));
    const float facing =
      instance && instance->IsMirrored ? -glm::dot(normal, direction) : glm::dot(normal, direction);
    if (facing < 0.f ? !traced.Data->Frontfaces : !traced.Data->Backfaces)
    {
      args->valid[i] = 0;
    }
    else if (args->valid[i] != 0 && traced.DepthTolerance > 0.f)
    {
      CandidateHit hit{ RTCHitN_geomID(args->hit, args->N, i),
        RTCHitN_primID(args->hit, args->N, i), RTCHitN_u(args->hit, args->N, i),
        RTCHitN_v(args->hit, args->N, i), RTCRayN_tfar(args->ray, args->N, i) };
      CandidateHits& candidates = context.Candidates[RTCRayN_id(args->ray, args->N, i)];
      if (!instance)
      {
        const float tolerance = traced.DepthTolerance / glm::length(direction);
        RTCRayN_tfar(args->ray, args->N, i) = std::min(
          candidates.Add(hit, tolerance, traced.IsLastInFront) + tolerance, candidates.Far);
        continue;
      }
      hit.Surface = instance->Surface;
      hit.Primitive += instance->First;
      hit.Distance = static_cast<float>(instance->Start + static_cast<double>(hit.Distance));
      const float tolerance = traced.DepthTolerance / instance->Length;
      const float far = std::min(candidates.Add(hit, tolerance, false) + tolerance, candidates.Far);
      RTCRayN_tfar(args->ray, args->N, i) = static_cast<float>(far - instance->Start);
    }
  }
}

/// Occlusion filter of line and point geometries: rejects every hit, because lines and points cast
/// no shadows.
void RejectAllFilter(const RTCFilterFunctionNArguments* args)
{
  std::fill_n(args->valid, args->N, 0);
}

/// Shares `data` with Embree if there is spare capacity behind the last element, since Embree reads
/// elements as 16 bytes; copies it otherwise, or if it is temporary.
template <typename T>
void SetBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
  const std::vector<T>& data, bool isTemporary = false)
{
  if (data.capacity() > data.size() && !isTemporary)
  {
    rtcSetSharedGeometryBuffer(geometry, type, 0, format, data.data(), 0, sizeof(T), data.size());
    return;
  }
  void* copy = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), data.size());
  if (!copy)
  {
    throw std::bad_alloc();
  }
  std::copy(data.begin(), data.end(), static_cast<T*>(copy));
}

}

RTCGeometry MakeTriangleGeometry(RTCDevice device, TracedSurface& traced)
{
  const Surface& surface = *traced.Data;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  SetBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, surface.Positions);
  std::vector<glm::uvec3> unique;
  if (traced.MayHaveCopies)
  {
    unique = RemoveCopies(surface, traced.IsLastInFront);
  }
  SetBuffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
    unique.empty() ? surface.Triangles : unique, !unique.empty());
  rtcSetGeometryUserData(geometry, &traced);
  if (!surface.Frontfaces || !surface.Backfaces || traced.DepthTolerance > 0.f)
  {
    rtcSetGeometryIntersectFilterFunction(geometry, IntersectFilter);
  }
  if (surface.IsLineOrPoint)
  {
    rtcSetGeometryOccludedFilterFunction(geometry, RejectAllFilter);
  }
  rtcCommitGeometry(geometry);
  return geometry;
}

}
