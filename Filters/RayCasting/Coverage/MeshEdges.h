// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The edges of one surface: which triangles meet there, and whether the picture may change across
// the edge from every view (border, crease, colour seam) or only where the surface folds over.
#ifndef penumbra_MeshEdges_h
#define penumbra_MeshEdges_h

#include "Scene.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

struct MeshEdge
{
  std::uint32_t A, B;        ///< the edge's positions
  std::uint32_t Left, Right; ///< the opposite positions of its two triangles; equal on a border
  bool IsFeatureEdge;        ///< drawn as a border from every view
};

/**
 * The edges of `surface` that can matter. Positions at the same place count as one, so that meshes
 * without shared points are connected. An edge between two triangles whose colours can differ by
 * no more than `contrast` (in [0, 1], under full light) is not a crease.
 */
std::vector<MeshEdge> FindMeshEdges(const Surface& surface, double contrast);

}
#endif
