// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Spheres and tubes as primitives of Embree's BVH. They are intersected in double precision.
#ifndef penumbra_RoundGeometry_h
#define penumbra_RoundGeometry_h

#include "EmbreeQuery.h"
#include "TracedSurface.h"

namespace penumbra
{

/**
 * Returns the geometry of a surface of spheres or tubes; `traced` must outlive it. A ray hits the
 * front of each shape, or its back if the front is nearer than the range of the ray. The back of a
 * translucent shape is hit only if the ray begins inside: its opacity is that of one layer, as in
 * VTK. Where translucent tubes are joined, a ray enters only one of them.
 */
RTCGeometry MakeRoundGeometry(RTCDevice device, TracedSurface& traced);

}
#endif
