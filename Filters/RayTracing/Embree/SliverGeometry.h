// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Surfaces whose triangles are not in Embree's BVH: a surface of slivers is one primitive, traced with
// a tree of oriented boxes; a surface with PlanarCells has one primitive per cell.
#ifndef penumbra_SliverGeometry_h
#define penumbra_SliverGeometry_h

#include "EmbreeQuery.h"
#include "TracedSurface.h"

namespace penumbra
{

/// Returns the geometry of a surface with a SliverTree or with PlanarCells; `traced` must outlive it.
/// Hits are those of MakeTriangleGeometry(), except for rounding. Of several triangles in one plane,
/// a ray hits the one of the lowest index.
RTCGeometry MakeSliverGeometry(RTCDevice device, TracedSurface& traced);

}
#endif
