// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DataSetValidation.h"

#include "Geometry/CurvedCells.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <sstream>

namespace penumbra
{

namespace
{

// Calls `visit(index, value)` for each value until it returns false; returns whether all calls returned
// true.
template <typename Visitor>
bool AllOfValues(vtkDataArray* array, const Visitor& visit)
{
  const vtkIdType count = array->GetNumberOfValues();
  const auto allOf = [&](const auto* values) {
    for (vtkIdType i = 0; i < count; ++i)
    {
      if (!visit(i, static_cast<vtkIdType>(values[i])))
      {
        return false;
      }
    }
    return true;
  };
  if (auto* wide = vtkAOSDataArrayTemplate<vtkTypeInt64>::FastDownCast(array))
  {
    return allOf(wide->GetPointer(0));
  }
  if (auto* narrow = vtkAOSDataArrayTemplate<vtkTypeInt32>::FastDownCast(array))
  {
    return allOf(narrow->GetPointer(0));
  }
  for (vtkIdType i = 0; i < count; ++i)
  {
    if (!visit(i, static_cast<vtkIdType>(array->GetComponent(i, 0))))
    {
      return false;
    }
  }
  return true;
}

std::string FindInconsistency(vtkCellArray* cells, vtkIdType points)
{
  if (!cells || cells->GetNumberOfCells() == 0)
  {
    return std::string();
  }
  vtkDataArray* connectivity = cells->GetConnectivityArray();
  const vtkIdType size = connectivity->GetNumberOfValues();
  vtkIdType before = 0;
  const bool ordered = AllOfValues(cells->GetOffsetsArray(), [&](vtkIdType i, vtkIdType offset) {
    const bool valid = offset >= before && offset <= size && (i > 0 || offset == 0);
    before = offset;
    return valid;
  });
  if (!ordered || before > size)
  {
    return "its cell offsets are not ascending or exceed the connectivity";
  }
  vtkIdType invalidId = 0;
  const bool inRange = AllOfValues(connectivity, [&](vtkIdType i, vtkIdType id) {
    invalidId = id;
    return (id >= 0 && id < points) || i >= before;
  });
  if (!inRange)
  {
    std::ostringstream message;
    message << "a cell uses point " << invalidId << ", but the data set has only " << points
            << " points";
    return message.str();
  }
  return std::string();
}

constexpr int UnknownType = -1;

// Returns the number of points of each cell type; 0 if it varies.
std::array<int, 256> CountCorners()
{
  std::array<int, 256> corners = {};
  for (int type = 0; type < static_cast<int>(corners.size()); ++type)
  {
    const auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type));
    corners[type] = !cell     ? UnknownType
      : type < VTK_POLYHEDRON ? static_cast<int>(cell->GetNumberOfPoints())
                              : 0;
  }
  return corners;
}

std::string FindInvalidCell(vtkUnstructuredGrid* grid)
{
  static const std::array<int, 256> corners = CountCorners();
  vtkCellArray* cells = grid->GetCells();
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    const int needed = corners[static_cast<unsigned char>(grid->GetCellType(cell))];
    if (needed == UnknownType)
    {
      return "cell " + std::to_string(cell) + " has the unknown type " +
        std::to_string(grid->GetCellType(cell));
    }
    if (needed > 0 && cells->GetCellSize(cell) != needed)
    {
      std::ostringstream message;
      message << "cell " << cell << " has " << cells->GetCellSize(cell) << " corners instead of "
              << needed;
      return message.str();
    }
  }
  return std::string();
}

std::string FindInconsistency(vtkDataSetAttributes* attributes, vtkIdType tuples)
{
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = attributes->GetAbstractArray(i);
    if (array && array->GetNumberOfTuples() < tuples)
    {
      return std::string("the array '") + (array->GetName() ? array->GetName() : "") +
        "' is too short";
    }
  }
  return std::string();
}

/// Returns whether three points are on one line, within `rounding` of their coordinates.
bool AreOnOneLine(vtkPoints* points, const vtkIdType* ids, double rounding)
{
  double corners[3][3];
  double edges[2][3];
  double normal[3];
  for (int i = 0; i < 3; ++i)
  {
    points->GetPoint(ids[i], corners[i]);
  }
  vtkMath::Subtract(corners[1], corners[0], edges[0]);
  vtkMath::Subtract(corners[2], corners[0], edges[1]);
  vtkMath::Cross(edges[0], edges[1], normal);
  return vtkMath::Norm(normal) <=
    rounding * std::max(vtkMath::Norm(edges[0]), vtkMath::Norm(edges[1]));
}

/// Returns whether all cells have zero area. The first corner of a polygon is in all its triangles; those
/// of a strip are three successive corners.
bool HaveZeroArea(vtkPoints* points, vtkCellArray* cells, bool areStrips, double rounding)
{
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    cells->GetCellAtId(cell, corners);
    for (vtkIdType i = 2; i < corners->GetNumberOfIds(); ++i)
    {
      const vtkIdType first = corners->GetId(areStrips ? i - 2 : 0);
      const vtkIdType triangle[3] = { first, corners->GetId(i - 1), corners->GetId(i) };
      if (!AreOnOneLine(points, triangle, rounding))
      {
        return false;
      }
    }
  }
  return true;
}

/// Returns whether the points of each line coincide.
bool HaveZeroLength(vtkPoints* points, vtkCellArray* lines)
{
  vtkNew<vtkIdList> ids;
  for (vtkIdType line = 0; line < lines->GetNumberOfCells(); ++line)
  {
    lines->GetCellAtId(line, ids);
    for (vtkIdType i = 1; i < ids->GetNumberOfIds(); ++i)
    {
      double first[3];
      double other[3];
      points->GetPoint(ids->GetId(0), first);
      points->GetPoint(ids->GetId(i), other);
      if (!std::equal(first, first + 3, other))
      {
        return false;
      }
    }
  }
  return true;
}

}

std::string FindInconsistency(vtkDataSet* data)
{
  std::string inconsistency;
  const auto check = [&inconsistency](const std::string& found) {
    inconsistency = inconsistency.empty() ? found : inconsistency;
  };
  const vtkIdType points = data->GetNumberOfPoints();
  if (auto* mesh = vtkPolyData::SafeDownCast(data))
  {
    for (vtkCellArray* cells :
      { mesh->GetVerts(), mesh->GetLines(), mesh->GetPolys(), mesh->GetStrips() })
    {
      check(FindInconsistency(cells, points));
    }
  }
  else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(data))
  {
    check(FindInconsistency(grid->GetCells(), points));
    if (inconsistency.empty())
    {
      check(FindInvalidCell(grid));
    }
  }
  if (inconsistency.empty())
  {
    check(FindInconsistency(data->GetPointData(), points));
    check(FindInconsistency(data->GetCellData(), data->GetNumberOfCells()));
  }
  return inconsistency;
}

bool HasOnlyZeroArea(vtkPolyData* mesh)
{
  if (mesh->GetNumberOfCells() == 0 || mesh->GetNumberOfVerts() > 0 ||
    mesh->GetCellData()->HasArray(CurvedFaceIds))
  {
    return false;
  }
  double bounds[6];
  mesh->GetBounds(bounds);
  double largest = 0.0;
  for (const double bound : bounds)
  {
    largest = std::max(largest, std::abs(bound));
  }
  vtkPoints* points = mesh->GetPoints();
  const bool isFloat = points->GetDataType() == VTK_FLOAT;
  // Each coordinate is off by half a unit in the last place.
  const double rounding = 2.0 * largest * (isFloat ? FLT_EPSILON : DBL_EPSILON);
  return HaveZeroLength(points, mesh->GetLines()) &&
    HaveZeroArea(points, mesh->GetPolys(), false, rounding) &&
    HaveZeroArea(points, mesh->GetStrips(), true, rounding);
}

}
