// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Collects the points and line segments of a poly data that are drawn as points and lines.
#ifndef penumbra_SceneExtractionSegments_h
#define penumbra_SceneExtractionSegments_h

#include "SceneExtractionItem.h"
#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

#include <cstdint>
#include <functional>
#include <vector>

namespace penumbra
{

/// Segment between two points of a cell, as point indices; a single point if From == To.
struct LineSegment
{
  std::uint32_t From;
  std::uint32_t To;
  std::uint32_t Cell;
  float Slope = 0.f; ///< of the steepest polygon at an edge or point, see PolygonSlope
};

/// Returns the depth that a polygon, of which it takes the ids of the points and their number,
/// traverses per pixel of the image, in pixels; negative if its edges are not drawn.
using PolygonSlope = std::function<double(const vtkIdType*, vtkIdType)>;

/// Returns the points of vertex cells. If `all` is true, returns the points of all cells, without
/// duplicates: of several cells, the point of that one is kept which VTK shows, the last one.
std::vector<LineSegment> CollectPoints(
  const DrawItem& item, bool all, const PolygonSlope& findSlope = {});

/// Returns the points of vertex cells, or of all cells if the representation is VTK_POINTS. Returns none if opaque
/// vertices of the same shape hide them.
std::vector<LineSegment> CollectVisiblePoints(const DrawItem& item);

/// Returns the segments of line cells.
std::vector<LineSegment> CollectLines(vtkPolyData* data);

/// Returns the edges of polygons and strips, without duplicates: of several cells, the edge of that
/// one is kept which VTK shows, the last one. Edges hidden by edge flags are skipped.
VTKPENUMBRAFILTERSSCENE_EXPORT std::vector<LineSegment> CollectEdges(
  const DrawItem& item, const PolygonSlope& findSlope = {});

/// Returns 0, 1, 2, ... for the cells of the item.
std::vector<std::uint32_t> MakeCellIndices(const DrawItem& item);

}
#endif
