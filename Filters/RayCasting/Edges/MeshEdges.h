// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The edges of one surface, with their adjacent triangles. The image may be discontinuous across a
// feature edge (boundary, crease, color seam) from every view, and across other edges only if they
// are silhouettes.
#ifndef penumbra_MeshEdges_h
#define penumbra_MeshEdges_h

#include "Camera.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

struct Surface;

/// An edge and its adjacent triangles.
struct MeshEdge
{
  std::uint32_t A, B; ///< indices of the two positions of the edge, in the order of coordinates
  std::uint32_t Left, Right; ///< opposite positions of its two triangles; equal on a boundary
  bool IsFeatureEdge;        ///< projected from every view
};

/**
 * Returns the edges of `surface`. Positions with equal coordinates count as one, which connects
 * meshes without shared points. An edge between two triangles is not a feature edge if their colors
 * differ by `contrast` at most (in [0, 1], under full light). If `isUnsteady` is true, the edges of
 * triangles with unsteady normals are feature edges.
 */
std::vector<MeshEdge> FindMeshEdges(const Surface& surface, double contrast, bool isUnsteady);

/**
 * Returns the silhouettes, boundaries and color seams of `surface` as seen from `camera`, and the
 * other feature edges of triangles that are larger than pixels. Uses little memory for meshes of
 * millions of triangles.
 */
std::vector<MeshEdge> FindEdgesOfDenseMesh(
  const Surface& surface, double contrast, const Camera& camera);

}
#endif
