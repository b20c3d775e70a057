// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Which points and segments of a poly data are drawn as points and lines.
#ifndef penumbra_SceneExtractionSegments_h
#define penumbra_SceneExtractionSegments_h

#include "SceneExtractionItem.h"

#include <cstdint>
#include <vector>

namespace penumbra
{

/// A segment between two points of a poly data, or a point (From == To), of one of its cells.
struct LineSegment
{
  std::uint32_t From;
  std::uint32_t To;
  std::uint32_t Cell;
};

/// Vertex cells, or with `all` the points of all cells, each once unless cells have colours.
std::vector<LineSegment> CollectPoints(const DrawItem& item, bool all);

/// Line cells.
std::vector<LineSegment> CollectLines(vtkPolyData* data);

/// The sides of polygons and strips, each once unless cells have colours. Edge flags are honoured.
std::vector<LineSegment> CollectEdges(const DrawItem& item);

/// 0, 1, 2, ... for every cell of the piece.
std::vector<std::uint32_t> MakeCellIndices(const DrawItem& item);

}
#endif
