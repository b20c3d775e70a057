// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A surface of slivers as one primitive of Embree's BVH, traced with a tree of oriented boxes.
#ifndef penumbra_SliverGeometry_h
#define penumbra_SliverGeometry_h

#include "EmbreeQuery.h"
#include "TracedSurface.h"

namespace penumbra
{

/// Returns the geometry of a surface with a SliverTree; `traced` must outlive it. Hits are those of
/// MakeTriangleGeometry(), except for rounding.
RTCGeometry MakeSliverGeometry(RTCDevice device, TracedSurface& traced);

}
#endif
