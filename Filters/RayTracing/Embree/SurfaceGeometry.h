// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Triangles, spheres and tubes as primitives of Embree's BVH, with the filters of their hits. A surface
// of slivers is one primitive, traced with a tree of oriented boxes; a surface with PlanarCells has one
// primitive per cell. Spheres and tubes are intersected in double precision.
#ifndef penumbra_Embree_SurfaceGeometry_h
#define penumbra_Embree_SurfaceGeometry_h

#include "EmbreeQuery.h"
#include "TracedSurface.h"

namespace penumbra
{

/// Callbacks of Embree for the primitives of a surface that are not Embree's own.
struct UserFunctions
{
  RTCBoundsFunction ComputeBounds;
  RTCIntersectFunctionN Intersect;
  RTCOccludedFunctionN Occlude;
};

/// Returns the surface from the user data of such a geometry.
inline const TracedSurface& GetTraced(const void* userData)
{
  return *static_cast<const TracedSurface*>(userData);
}

/// Makes a geometry of `count` primitives of a surface. `traced` must outlive it.
inline RTCGeometry MakeUserGeometry(
  RTCDevice device, TracedSurface& traced, std::size_t count, const UserFunctions& functions)
{
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned int>(count));
  rtcSetGeometryUserData(geometry, &traced);
  rtcSetGeometryBoundsFunction(geometry, functions.ComputeBounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, functions.Intersect);
  rtcSetGeometryOccludedFunction(geometry, functions.Occlude);
  rtcCommitGeometry(geometry);
  return geometry;
}

/// Returns the geometry of a surface of triangles; `traced` must outlive it. Rays skip culled
/// sides. Hits that may coincide with other surfaces are collected in QueryContext::Candidates.
/// Lines and points do not occlude. Throws std::bad_alloc.
RTCGeometry MakeTriangleGeometry(RTCDevice device, TracedSurface& traced);

/// Returns the geometry of a surface with a SliverTree or with PlanarCells; `traced` must outlive it.
/// Hits are those of MakeTriangleGeometry(), except for rounding. Of several triangles in one plane,
/// a ray hits the one of the lowest index.
RTCGeometry MakeSliverGeometry(RTCDevice device, TracedSurface& traced);

/**
 * Returns the geometry of a surface of spheres or tubes; `traced` must outlive it. A ray hits the
 * front of each shape, or its back if the front is nearer than the range of the ray. The back of a
 * translucent shape is hit only if the ray begins inside: its opacity is that of one layer, as in
 * VTK. Where translucent tubes are joined, a ray enters only one of them.
 */
RTCGeometry MakeRoundGeometry(RTCDevice device, TracedSurface& traced);

}
#endif
