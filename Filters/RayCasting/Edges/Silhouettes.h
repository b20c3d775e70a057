// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Edges at which the image may be discontinuous, projected in double precision and binned into
// tiles and pixels.
#ifndef penumbra_Silhouettes_h
#define penumbra_Silhouettes_h

#include "Camera.h"
#include "Execution/ParallelBins.h"
#include "MeshEdges.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace penumbra
{

struct Surface;

/// A projected edge in image coordinates (pixels).
struct ProjectedEdge
{
  glm::dvec2 A;
  glm::dvec2 B;
  /// Value at A and B that is linear along the projected edge: 1/depth in perspective projection,
  /// depth in parallel projection.
  double DepthA;
  double DepthB;
  /// Surface and primitive whose outline it is, if that is a sphere or a tube.
  std::uint32_t RoundSurface = NoSurface;
  std::uint32_t RoundPrimitive = 0;

  static constexpr std::uint32_t NoSurface = 0xffffffffu;
  bool IsRound() const { return this->RoundSurface != NoSurface; }
};

/// Indices of edges in the cells of a regular grid.
using EdgeBins = Bins<std::uint32_t>;

/// Distance in pixels up to which an edge outside a cell is also binned into it. Above
/// EdgePrecision, so that a pixel has all edges that may affect its corner rays.
constexpr double EdgeMargin = 2e-3;

/**
 * Bins the edges into a grid of `cells.x` by `cells.y` squares of side `size` with the lower left
 * corner `origin`. `subset` lists `count` indices of edges; null: the first `count` edges. The bins
 * are conservative by EdgeMargin.
 */
void BinEdges(const std::vector<ProjectedEdge>& edges, const std::uint32_t* subset,
  std::size_t count, glm::dvec2 origin, double size, glm::ivec2 cells, EdgeBins& bins);

/// Clips an edge to the rectangle [low, high] of the image. Returns false if nothing is left.
bool ClipToRectangle(ProjectedEdge& edge, glm::dvec2 low, glm::dvec2 high);

/// Appends the projection of the edge from `a` to `b`, clipped to the near plane and to the
/// rectangle [low, high].
void ProjectEdge(glm::dvec3 a, glm::dvec3 b, const Camera& camera, glm::dvec2 low, glm::dvec2 high,
  std::vector<ProjectedEdge>& edges);

/// A part of an image in pixels, [Low, High). Edges are clipped to the image, not to the part, so that their
/// bits do not depend on it.
struct ImagePart
{
  glm::dvec2 ImageLow, ImageHigh; ///< the image, enlarged by twice EdgeMargin
  glm::dvec2 Low, High;

  ImagePart(const Camera& camera, glm::ivec2 low, glm::ivec2 high);

  /// Removes the edges from index `first` on that are not in this part. Returns the number of the others
  /// that begin in it, so that each edge begins in one of the parts that divide an image.
  long long Select(std::size_t first, std::vector<ProjectedEdge>& edges) const;
};

/// Appends the feature edges and silhouettes of `surface` as seen from `camera` that are in a part of the
/// image. They are clipped to the near plane and to the image. Returns the number of edges that begin in
/// the part.
long long ProjectEdges(const Surface& surface, const std::vector<MeshEdge>& mesh,
  const Camera& camera, const ImagePart& part, std::vector<ProjectedEdge>& edges);

}
#endif
