// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Data of a surface that the callbacks of Embree use.
#ifndef penumbra_TracedSurface_h
#define penumbra_TracedSurface_h

#include <cstdint>
#include <memory>
#include <vector>

struct RTCSceneTy;

namespace penumbra
{

struct Surface;

class PlanarCells;
class SliverTree;

/// Data of a surface that the callbacks of Embree use.
struct TracedSurface
{
  const Surface* Data = nullptr;
  bool IsAttached = false; ///< it has a geometry in the scene of Embree
  float DepthTolerance = 0.f;
  bool IsLastInFront = false;                ///< see CoincidentSurfaces
  bool IsTranslucent = false;                ///< of spheres and tubes only
  bool MayHaveCopies = false;                ///< the boxes of many triangles overlap
  std::shared_ptr<const SliverTree> Slivers; ///< replaces Embree's BVH of the triangles if not null
  std::shared_ptr<const PlanarCells>
    Cells;                     ///< Embree's primitives instead of triangles if not null
  RTCSceneTy* Shape = nullptr; ///< BVH of the triangles that have instances, or null
  /// Spheres in the order in which Embree's primitives group them; empty: a primitive for each.
  std::vector<std::uint32_t> Order = {};
};

}
#endif
