// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The edges where the picture can change, projected in double and sorted into tiles and pixels.
#ifndef penumbra_Silhouettes_h
#define penumbra_Silhouettes_h

#include "MeshEdges.h"
#include "Scene.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

/// A projected edge in picture coordinates.
struct ProjectedEdge
{
  glm::dvec2 A;
  glm::dvec2 B;
  /// Depth along the edge is linear in 1/depth (perspective) or in depth (parallel): the value at
  /// either end.
  double DepthA;
  double DepthB;
};

/// Lists of edges per cell of a regular grid, in one array.
struct EdgeBins
{
  std::vector<std::uint32_t> Begin; ///< per cell, and the end
  std::vector<std::uint32_t> Edges;
};

/// How near to a pixel an edge must pass to be listed with it, in pixels: more than the precision
/// of a ray.
constexpr double EdgeMargin = 2e-3;

/**
 * Sorts the edges chosen by `subset` (all, if null) into the cells of `cells.x` by `cells.y` squares
 * of side `size` whose lower left corner is `origin`. Conservative by EdgeMargin.
 */
void BinEdges(const std::vector<ProjectedEdge>& edges, const std::uint32_t* subset,
  std::size_t count, glm::dvec2 origin, double size, glm::ivec2 cells, EdgeBins& lists);

/**
 * Appends the edges of `surface` that are borders seen from `camera`, clipped to the front of it and
 * to the rectangle [low, high] of the picture (with a margin).
 */
void ProjectEdges(const Surface& surface, const std::vector<MeshEdge>& mesh, const Camera& camera,
  glm::dvec2 low, glm::dvec2 high, std::vector<ProjectedEdge>& edges);

}
#endif
