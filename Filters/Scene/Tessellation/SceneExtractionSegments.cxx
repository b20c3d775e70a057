// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SceneExtractionSegments.h"

#include "vtkCellArray.h"
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

/// Calls use(ids, size, cell) for the cells of an array whose first cell has the number `first`.
template <typename Function>
void ForEachCell(vtkCellArray* cells, vtkIdType first, Function&& use)
{
  vtkNew<vtkIdList> cell;
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
  {
    cells->GetCellAtId(i, cell);
    use(cell->GetPointer(0), cell->GetNumberOfIds(), static_cast<std::uint32_t>(first + i));
  }
}

void Append(std::vector<LineSegment>& marks, vtkIdType from, vtkIdType to, std::uint32_t cell)
{
  // Negative or huge ids wrap to numbers that no point has, and are dropped with these.
  marks.push_back({ static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to), cell });
}

/// Leaves of marks between the same two points the first.
void MakeUnique(std::vector<LineSegment>& marks)
{
  const auto key = [](const LineSegment& mark) {
    return std::make_tuple(
      std::min(mark.From, mark.To), std::max(mark.From, mark.To), mark.Cell, mark.From);
  };
  std::sort(marks.begin(), marks.end(),
    [&](const LineSegment& a, const LineSegment& b) { return key(a) < key(b); });
  const auto same = [](const LineSegment& a, const LineSegment& b) {
    return std::minmax(a.From, a.To) == std::minmax(b.From, b.To);
  };
  marks.erase(std::unique(marks.begin(), marks.end(), same), marks.end());
}

}

std::vector<LineSegment> CollectPoints(const DrawItem& piece, bool all)
{
  std::vector<LineSegment> marks;
  vtkPolyData* data = piece.Data;
  vtkCellArray* arrays[] = { data->GetVerts(), data->GetLines(), data->GetPolys(),
    data->GetStrips() };
  vtkIdType first = 0;
  for (vtkCellArray* cells : arrays)
  {
    ForEachCell(cells, first, [&](const vtkIdType* ids, vtkIdType size, std::uint32_t cell) {
      for (vtkIdType i = 0; i < size; ++i)
      {
        Append(marks, ids[i], ids[i], cell);
      }
    });
    first += cells->GetNumberOfCells();
    if (!all)
    {
      break;
    }
  }
  if (all && piece.Colors.Way != Coloring::Ways::PerCell)
  {
    MakeUnique(marks);
  }
  return marks;
}

std::vector<LineSegment> CollectLines(vtkPolyData* data)
{
  std::vector<LineSegment> marks;
  ForEachCell(data->GetLines(), data->GetVerts()->GetNumberOfCells(),
    [&](const vtkIdType* ids, vtkIdType size, std::uint32_t cell) {
      for (vtkIdType i = 0; i + 1 < size; ++i)
      {
        Append(marks, ids[i], ids[i + 1], cell);
      }
    });
  return marks;
}

std::vector<LineSegment> CollectEdges(const DrawItem& piece)
{
  std::vector<LineSegment> marks;
  vtkPolyData* data = piece.Data;
  const vtkIdType points = data->GetNumberOfPoints();
  vtkDataArray* flags = data->GetPointData()->GetAttribute(vtkDataSetAttributes::EDGEFLAG);
  const auto isHidden = [&](vtkIdType id) {
    return flags && id >= 0 && id < points && flags->GetComponent(id, 0) == 0.0;
  };
  vtkIdType first = data->GetVerts()->GetNumberOfCells() + data->GetLines()->GetNumberOfCells();
  ForEachCell(
    data->GetPolys(), first, [&](const vtkIdType* ids, vtkIdType size, std::uint32_t cell) {
      for (vtkIdType i = 0; i < size; ++i)
      {
        if (!isHidden(ids[i]))
        {
          Append(marks, ids[i], ids[(i + 1) % size], cell);
        }
      }
    });
  first += data->GetPolys()->GetNumberOfCells();
  ForEachCell(
    data->GetStrips(), first, [&](const vtkIdType* ids, vtkIdType size, std::uint32_t cell) {
      for (vtkIdType i = 0; i + 1 < size; ++i)
      {
        Append(marks, ids[i], ids[i + 1], cell);
        if (i + 2 < size)
        {
          Append(marks, ids[i], ids[i + 2], cell);
        }
      }
    });
  marks.erase(std::remove_if(marks.begin(), marks.end(),
                [](const LineSegment& mark) { return mark.From == mark.To; }),
    marks.end());
  if (piece.Colors.Way != Coloring::Ways::PerCell)
  {
    MakeUnique(marks);
  }
  return marks;
}

std::vector<std::uint32_t> MakeCellNumbers(const DrawItem& piece)
{
  std::vector<std::uint32_t> numbers(static_cast<std::size_t>(piece.Data->GetNumberOfCells()));
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

}
