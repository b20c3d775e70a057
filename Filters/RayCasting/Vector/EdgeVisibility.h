// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Visible parts of edges. Rays at most half a pixel apart test the visibility, and
// bisection finds the points where it changes.
#ifndef penumbra_EdgeVisibility_h
#define penumbra_EdgeVisibility_h

#include "Edges/MeshEdges.h"
#include "Sampling/CameraRayTracer.h"
#include "VectorFigure.h"

#include <functional>
#include <utility>
#include <vector>

namespace penumbra
{

/// Returns the side length of a pixel at a depth, in scene units.
double ComputePixelSize(const Camera& camera, double depth);

/// Returns the intervals of [0, 1] in which `isVisible` holds, for a segment of `length` pixels.
/// Intervals shorter than half a pixel may be missed.
std::vector<std::pair<double, double>> FindVisibleIntervals(
  double length, const std::function<bool(double)>& isVisible);

/// Appends the visible parts of silhouettes, boundaries and creases, and of the outlines of spheres
/// and tubes as polylines, with the width and color of `pen`. `edges`: the edges of each surface.
void AddVisibleOutlines(const CameraRayTracer& tracer,
  const std::vector<std::vector<MeshEdge>>& edges, const FigurePath& pen,
  std::vector<FigurePath>& paths);

}
#endif
