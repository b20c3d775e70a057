// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Triangles as primitives of Embree's BVH, with the filters of their hits. Some surfaces are not in
// Embree's BVH: a surface of slivers is one primitive, traced with a tree of oriented boxes; a
// surface with PlanarCells has one primitive per cell.
#ifndef penumbra_TriangleGeometry_h
#define penumbra_TriangleGeometry_h

#include "EmbreeQuery.h"
#include "TracedSurface.h"

namespace penumbra
{

/// Returns the geometry of a surface of triangles; `traced` must outlive it. Rays skip culled
/// sides. Hits that may coincide with other surfaces are collected in QueryContext::Candidates.
/// Lines and points do not occlude. Throws std::bad_alloc.
RTCGeometry MakeTriangleGeometry(RTCDevice device, TracedSurface& traced);

/// Returns the geometry of a surface with a SliverTree or with PlanarCells; `traced` must outlive it.
/// Hits are those of MakeTriangleGeometry(), except for rounding. Of several triangles in one plane,
/// a ray hits the one of the lowest index.
RTCGeometry MakeSliverGeometry(RTCDevice device, TracedSurface& traced);

}
#endif
