// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionSegments.h"

#include "Geometry/CurvedCells.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace penumbra
{
namespace
{

/// Calls callback(ids, size, cell) for the cells of an array whose first cell has the index
/// `first`.
template <typename Function>
void ForEachCell(vtkCellArray* cells, vtkIdType first, Function&& callback)
{
  vtkNew<vtkIdList> cell;
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
  {
    cells->GetCellAtId(i, cell);
    callback(cell->GetPointer(0), cell->GetNumberOfIds(), static_cast<std::uint32_t>(first + i));
  }
}

void Append(std::vector<LineSegment>& segments, vtkIdType from, vtkIdType to, std::uint32_t cell,
  double slope = 0.0)
{
  // Out-of-range ids wrap to invalid point indices, which LineExpander skips.
  segments.push_back({ static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to), cell,
    static_cast<float>(slope) });
}

/// Returns true if a line between two points has no length: VTK draws nothing, also as a tube.
bool HasNoLength(vtkPolyData* data, vtkIdType from, vtkIdType to)
{
  const vtkIdType count = data->GetNumberOfPoints();
  if (from < 0 || to < 0 || from >= count || to >= count)
  {
    return false;
  }
  double a[3];
  double b[3];
  data->GetPoint(from, a);
  data->GetPoint(to, b);
  return std::equal(a, a + 3, b);
}

/// Keeps the first of the segments between the same two points.
void RemoveDuplicates(std::vector<LineSegment>& segments)
{
  const auto key = [](const LineSegment& segment) {
    return std::make_tuple(std::min(segment.From, segment.To), std::max(segment.From, segment.To),
      segment.Cell, segment.From);
  };
  std::sort(segments.begin(), segments.end(),
    [&](const LineSegment& a, const LineSegment& b) { return key(a) < key(b); });
  const auto same = [](const LineSegment& a, const LineSegment& b) {
    return std::minmax(a.From, a.To) == std::minmax(b.From, b.To);
  };
  for (std::size_t i = segments.size(); i-- > 1;)
  {
    if (same(segments[i - 1], segments[i]))
    {
      segments[i - 1].Slope = std::max(segments[i - 1].Slope, segments[i].Slope);
    }
  }
  segments.erase(std::unique(segments.begin(), segments.end(), same), segments.end());
}

/// Returns true if the two segments between the same points may differ in color or in shading.
bool AreCellsDistinct(const DrawItem& item)
{
  return item.Colors.Mode == Coloring::Modes::PerCell || item.Data->GetCellData()->GetNormals();
}

/// Returns the opacity of a cell in [0, 255], as far as colors per cell determine it.
int GetOpacity(const DrawItem& item, std::uint32_t cell)
{
  const bool isPerCell = item.Colors.Mode == Coloring::Modes::PerCell;
  return isPerCell ? static_cast<int>(item.Colors.Colors->GetComponent(cell, 3)) : 255;
}

/// Keeps the visible one of the segments between the same two points: the most opaque one, or of
/// equal ones the last one, which passes the depth test of VTK. The order remains.
void KeepVisibleDuplicates(const DrawItem& item, std::vector<LineSegment>& segments)
{
  std::vector<std::uint32_t> order(segments.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto ends = [&](std::uint32_t i) {
    return std::make_pair(
      std::min(segments[i].From, segments[i].To), std::max(segments[i].From, segments[i].To));
  };
  const auto key = [&](std::uint32_t i) {
    return std::make_tuple(ends(i), GetOpacity(item, segments[i].Cell), i);
  };
  std::sort(
    order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<bool> isHidden(segments.size(), false);
  for (std::size_t i = 0; i + 1 < order.size(); ++i)
  {
    isHidden[order[i]] = ends(order[i]) == ends(order[i + 1]);
    if (isHidden[order[i]])
    {
      float& slope = segments[order[i + 1]].Slope;
      slope = std::max(slope, segments[order[i]].Slope);
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    if (!isHidden[i])
    {
      segments[kept++] = segments[i];
    }
  }
  segments.resize(kept);
}

/// Keeps one of the segments between the same two points, with the largest of their slopes.
void ResolveDuplicates(const DrawItem& item, std::vector<LineSegment>& segments)
{
  AreCellsDistinct(item) ? KeepVisibleDuplicates(item, segments) : RemoveDuplicates(segments);
}

/// Removes the segments between two polygons that are parts of one face, see CurvedFaceIds.
void RemoveInnerEdges(vtkDataArray* faces, std::vector<LineSegment>& segments)
{
  struct Side
  {
    std::uint32_t Low;
    std::uint32_t High;
    double Face;
    std::size_t Segment;
  };
  std::vector<Side> sides;
  sides.reserve(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    const auto [low, high] = std::minmax(segments[i].From, segments[i].To);
    sides.push_back({ low, high, faces->GetComponent(segments[i].Cell, 0), i });
  }
  const auto key = [](const Side& side) { return std::tie(side.Low, side.High, side.Face); };
  std::sort(
    sides.begin(), sides.end(), [&](const Side& a, const Side& b) { return key(a) < key(b); });
  std::vector<bool> isInner(segments.size(), false);
  for (std::size_t i = 0; i + 1 < sides.size(); ++i)
  {
    if (key(sides[i]) == key(sides[i + 1]))
    {
      isInner[sides[i].Segment] = isInner[sides[i + 1].Segment] = true;
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    if (!isInner[i])
    {
      segments[kept++] = segments[i];
    }
  }
  segments.resize(kept);
}

}

std::vector<LineSegment> CollectPoints(
  const DrawItem& item, bool all, const PolygonSlope& findSlope)
{
  std::vector<LineSegment> segments;
  vtkPolyData* data = item.Data;
  vtkCellArray* arrays[] = { data->GetVerts(), data->GetLines(), data->GetPolys(),
    data->GetStrips() };
  if (!all)
  {
    segments.reserve(static_cast<std::size_t>(data->GetVerts()->GetNumberOfConnectivityIds()));
  }
  vtkIdType first = 0;
  for (vtkCellArray* cells : arrays)
  {
    ForEachCell(cells, first, [&](const vtkIdType* ids, vtkIdType size, std::uint32_t cell) {
      const bool isStrip = findSlope && cells == data->GetStrips();
      const double ofPolygon = findSlope && cells == data->GetPolys() ? findSlope(ids, size) : 0.0;
      for (vtkIdType i = 0; i < size; ++i)
      {
        double slope = std::max(ofPolygon, 0.0);
        for (vtkIdType k = std::max<vtkIdType>(i - 2, 0); isStrip && k <= i && k + 2 < size; ++k)
        {
          slope = std::max(slope, findSlope(ids + k, 3));
        }
        Append(segments, ids[i], ids[i], cell, slope);
      }
    });
    first += cells->GetNumberOfCells();
    if (!all)
    {
      break;
    }
  }
  if (all)
  {
    ResolveDuplicates(item, segments);
  }
  return segments;
}

std::vector<LineSegment> CollectVisiblePoints(const DrawItem& item)
{
  vtkProperty* property = item.Property;
  const bool haveSize = item.Radii || item.PointRadius > 0.0;
  const bool areHidden =
    property->GetVertexVisibility() && property->GetOpacity() >= 1.0 && !haveSize;
  return areHidden ? std::vector<LineSegment>()
                   : CollectPoints(item, property->GetRepresentation() == VTK_POINTS);
}

std::vector<LineSegment> CollectLines(vtkPolyData* data)
{
  std::vector<LineSegment> segments;
  ForEachCell(data->GetLines(), data->GetVerts()->GetNumberOfCells(),
    [&](const vtkIdType* ids, vtkIdType size, std::uint32_t cell) {
      for (vtkIdType i = 0; i + 1 < size; ++i)
      {
        if (!HasNoLength(data, ids[i], ids[i + 1]))
        {
          Append(segments, ids[i], ids[i + 1], cell);
        }
      }
    });
  return segments;
}

std::vector<LineSegment> CollectEdges(const DrawItem& item, const PolygonSlope& findSlope)
{
  std::vector<LineSegment> segments;
  vtkPolyData* data = item.Data;
  const vtkIdType points = data->GetNumberOfPoints();
  vtkDataArray* flags = data->GetPointData()->GetAttribute(vtkDataSetAttributes::EDGEFLAG);
  const auto isHidden = [&](vtkIdType id) {
    return flags && id >= 0 && id < points && flags->GetComponent(id, 0) == 0.0;
  };
  vtkIdType first = data->GetVerts()->GetNumberOfCells() + data->GetLines()->GetNumberOfCells();
  ForEachCell(
    data->GetPolys(), first, [&](const vtkIdType* ids, vtkIdType size, std::uint32_t cell) {
      const double slope = findSlope ? findSlope(ids, size) : 0.0;
      for (vtkIdType i = 0; slope >= 0.0 && i < size; ++i)
      {
        if (!isHidden(ids[i]))
        {
          Append(segments, ids[i], ids[(i + 1) % size], cell, slope);
        }
      }
    });
  vtkDataArray* faces = data->GetCellData()->GetArray(CurvedFaceIds);
  if (faces && faces->GetNumberOfTuples() == data->GetNumberOfCells())
  {
    RemoveInnerEdges(faces, segments);
  }
  first += data->GetPolys()->GetNumberOfCells();
  ForEachCell(
    data->GetStrips(), first, [&](const vtkIdType* ids, vtkIdType size, std::uint32_t cell) {
      double slopeBefore = -1.0; // of the triangle before, which has the edge from i to i + 1, too
      for (vtkIdType i = 0; i + 1 < size; ++i)
      {
        double slope = i + 2 < size ? 0.0 : -1.0;
        if (slope >= 0.0 && findSlope)
        {
          const vtkIdType corners[3] = { ids[i], ids[i + 1 + i % 2], ids[i + 2 - i % 2] };
          slope = findSlope(corners, 3);
        }
        if (slope >= 0.0 || slopeBefore >= 0.0)
        {
          Append(segments, ids[i], ids[i + 1], cell, std::max(slope, slopeBefore));
        }
        if (slope >= 0.0)
        {
          Append(segments, ids[i], ids[i + 2], cell, slope);
        }
        slopeBefore = slope;
      }
    });
  segments.erase(std::remove_if(segments.begin(), segments.end(),
                   [](const LineSegment& segment) { return segment.From == segment.To; }),
    segments.end());
  ResolveDuplicates(item, segments);
  return segments;
}

std::vector<std::uint32_t> MakeCellIndices(const DrawItem& item)
{
  std::vector<std::uint32_t> numbers(static_cast<std::size_t>(item.Data->GetNumberOfCells()));
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

}
