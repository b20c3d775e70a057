// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CurvedCells.h"

#include "SurfaceGeometry.h"

#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkDataSetSurfaceFilter.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVersionMacros.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <tuple>
#include <vector>

#include <glm/glm.hpp>

namespace penumbra
{
namespace
{

/// Accepted distance between the triangles and the cells, as a fraction of the diagonal.
constexpr double CurveTolerance = 1e-4;
/// Maximum number of triangles of a surface, unless it has more with the fewest subdivisions.
constexpr double MaximumTriangles = 4e6;
/// Maximum number of subdivisions.
constexpr int MaximumLevel = 8;

bool HasCurvedCells(vtkUnstructuredGridBase* grid)
{
  std::set<int> linear;
  vtkNew<vtkGenericCell> cell;
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    const int type = grid->GetCellType(i);
    if (linear.count(type) > 0)
    {
      continue;
    }
    grid->GetCell(i, cell);
    if (!cell->IsLinear())
    {
      return true;
    }
    linear.insert(type);
  }
  return false;
}

/// vtkDataSetSurfaceFilter of VTK 9.2 crashes when it subdivides lines.
constexpr bool SubdividesLines = VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0);

/// Number of triangles or segments into which VTK divides the faces or lines of a grid, and their
/// largest distance from these.
struct Triangulation
{
  std::size_t Count = 0;
  double Deviation = 0.0;
};

/// Adds the triangles of a face or the segments of a line. The distance is measured at the centers of edges.
void Measure(vtkCell* face, Triangulation& result)
{
  vtkNew<vtkIdList> ids;
  vtkNew<vtkPoints> corners;
  face->Triangulate(0, ids, corners);
  const int size = face->GetCellDimension() + 1;
  result.Count += static_cast<std::size_t>(ids->GetNumberOfIds() / size);
  const double* parameters = face->IsLinear() ? nullptr : face->GetParametricCoords();
  if (!parameters)
  {
    return;
  }
  std::vector<double> weights(static_cast<std::size_t>(face->GetNumberOfPoints()));
  const auto getParameters = [&](vtkIdType corner) {
    const double* p = parameters + 3 * face->GetPointIds()->IsId(ids->GetId(corner));
    return glm::dvec3(p[0], p[1], p[2]);
  };
  for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
  {
    const vtkIdType next = i % size == size - 1 ? i - size + 1 : i + 1;
    glm::dvec3 center = 0.5 * (getParameters(i) + getParameters(next));
    glm::dvec3 x;
    glm::dvec3 a;
    glm::dvec3 b;
    int part = 0;
    face->EvaluateLocation(part, &center.x, &x.x, weights.data());
    corners->GetPoint(i, &a.x);
    corners->GetPoint(next, &b.x);
    const double deviation = glm::distance(x, 0.5 * (a + b));
    result.Deviation = std::max(result.Deviation, deviation);
  }
}

/// Returns the number of subdivisions that reach the tolerance. Each divides the deviation by four
/// and multiplies the number of triangles by four.
int FindLevel(vtkUnstructuredGrid* faces, const ProgressCallback& progress)
{
  Triangulation first;
  vtkNew<vtkGenericCell> face;
  for (vtkIdType i = 0; i < faces->GetNumberOfCells(); ++i)
  {
    if (i % StoppableCells == 0)
    {
      ThrowIfStopped(progress, 0.0);
    }
    faces->GetCell(i, face);
    if (face->GetCellDimension() == 2 || (SubdividesLines && face->GetCellDimension() == 1))
    {
      Measure(face, first);
    }
  }
  const double accepted = CurveTolerance * faces->GetLength();
  int level = 1;
  double deviation = first.Deviation;
  double count = 4.0 * static_cast<double>(first.Count);
  // The comparison is false for NaN.
  while (deviation > accepted && count <= MaximumTriangles && level < MaximumLevel)
  {
    deviation /= 4.0;
    count *= 4.0;
    ++level;
  }
  return level;
}

/// A face of a three-dimensional cell. Cells that share a face have faces of the same corners.
struct CellFace
{
  std::uint64_t Hash; ///< of the ids of the corners
  vtkIdType Lowest;   ///< lowest id
  vtkIdType Cell;
  int Index;

  bool HasSameCorners(const CellFace& other) const
  {
    return this->Hash == other.Hash && this->Lowest == other.Lowest;
  }
};

CellFace MakeCellFace(vtkCell* face, vtkIdType cell, int index, std::vector<vtkIdType>& ids)
{
  // The corners are the first points, and there are as many edges.
  const vtkIdType* points = face->GetPointIds()->GetPointer(0);
  ids.assign(
    points, points + std::min<vtkIdType>(face->GetNumberOfEdges(), face->GetNumberOfPoints()));
  std::sort(ids.begin(), ids.end());
  std::uint64_t hash = 0xcbf29ce484222325u; // Fowler-Noll-Vo, with a shift for the high bits
  for (const vtkIdType id : ids)
  {
    hash = (hash ^ static_cast<std::uint64_t>(id)) * 0x100000001b3u;
    hash ^= hash >> 29;
  }
  return { hash, ids.empty() ? 0 : ids.front(), cell, index };
}

/// Returns the faces that only one cell has, in the order of the cells.
std::vector<CellFace> FindOuterFaces(
  vtkUnstructuredGridBase* grid, const ProgressCallback& progress)
{
  std::vector<CellFace> faces;
  std::vector<vtkIdType> ids;
  vtkNew<vtkGenericCell> cell;
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    if (i % StoppableCells == 0)
    {
      ThrowIfStopped(progress, 0.0);
    }
    grid->GetCell(i, cell);
    for (int index = 0; cell->GetCellDimension() == 3 && index < cell->GetNumberOfFaces(); ++index)
    {
      faces.push_back(MakeCellFace(cell->GetFace(index), i, index, ids));
    }
  }
  std::sort(faces.begin(), faces.end(), [](const CellFace& a, const CellFace& b) {
    return std::tie(a.Hash, a.Lowest) < std::tie(b.Hash, b.Lowest);
  });
  std::vector<CellFace> outer;
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    if ((i == 0 || !faces[i].HasSameCorners(faces[i - 1])) &&
      (i + 1 == faces.size() || !faces[i].HasSameCorners(faces[i + 1])))
    {
      outer.push_back(faces[i]);
    }
  }
  std::sort(outer.begin(), outer.end(), [](const CellFace& a, const CellFace& b) {
    return std::tie(a.Cell, a.Index) < std::tie(b.Cell, b.Index);
  });
  return outer;
}

/// Returns the degree of a face of higher order in a parametric direction.
double FindDegree(vtkCell* face, int direction)
{
  std::set<double> values;
  const double* parameters = face->GetParametricCoords();
  for (vtkIdType i = 0; parameters && i < face->GetNumberOfPoints(); ++i)
  {
    values.insert(std::round(1e6 * parameters[3 * i + direction]));
  }
  return values.empty() ? 1.0 : static_cast<double>(values.size() - 1);
}

/// Returns a grid of the cells of at most two dimensions and the outer faces of the others, without
/// ghost cells. vtkUnstructuredGridGeometryFilter does the same, but its layout differs between
/// releases of VTK 9.7, with all of which the modules of Python run.
vtkSmartPointer<vtkUnstructuredGrid> ExtractFaces(
  vtkUnstructuredGridBase* grid, const char* cellIds, const ProgressCallback& progress)
{
  const std::vector<CellFace> outer = FindOuterFaces(grid, progress);
  auto faces = vtkSmartPointer<vtkUnstructuredGrid>::New();
  faces->SetPoints(grid->GetPoints());
  faces->GetPointData()->ShallowCopy(grid->GetPointData());
  vtkCellData* attributes = faces->GetCellData();
  attributes->CopyAllocate(grid->GetCellData());
  vtkDataArray* degrees = grid->GetCellData()->GetHigherOrderDegrees();
  const char* degreesName = degrees ? degrees->GetName() : nullptr;
  vtkNew<vtkIdTypeArray> ids;
  const auto append = [&](vtkCell* face, vtkIdType from) {
    const vtkIdType to = faces->InsertNextCell(face->GetCellType(), face->GetPointIds());
    attributes->CopyData(grid->GetCellData(), from, to);
    vtkDataArray* copied = degreesName ? attributes->GetArray(degreesName) : nullptr;
    if (copied && face->GetCellDimension() == 2)
    {
      copied->SetTuple3(to, FindDegree(face, 0), FindDegree(face, 1), 0.0);
    }
    ids->InsertNextValue(from);
  };
  vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray();
  vtkNew<vtkGenericCell> cell;
  auto next = outer.begin();
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    constexpr int ghost = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
    const bool isGhost = ghosts && (ghosts->GetValue(i) & ghost) != 0;
    grid->GetCell(i, cell);
    if (!isGhost && cell->GetCellDimension() < 3)
    {
      append(cell, i);
    }
    for (; next != outer.end() && next->Cell == i; ++next)
    {
      if (!isGhost)
      {
        append(cell->GetFace(next->Index), i);
      }
    }
  }
  if (cellIds)
  {
    ids->SetName(cellIds);
    attributes->AddArray(ids);
  }
  return faces;
}

}

vtkSmartPointer<vtkPolyData> ExtractCurvedSurface(
  vtkDataSet* data, const char* cellIds, const ProgressCallback& progress)
{
  auto* grid = vtkUnstructuredGridBase::SafeDownCast(data);
  if (!grid || !HasCurvedCells(grid))
  {
    return nullptr;
  }
  const vtkSmartPointer<vtkUnstructuredGrid> cells = ExtractFaces(grid, cellIds, progress);
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputData(cells);
  surface->SetNonlinearSubdivisionLevel(FindLevel(cells, progress));
  surface->PassThroughCellIdsOn();
  surface->SetOriginalCellIdsName(CurvedFaceIds);
  UpdateStoppably(surface, progress);
  return surface->GetOutput();
}

}
