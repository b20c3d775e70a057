// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CurvedCells.h"

#include "CurvedFaceIds.h"
#include "SurfaceGeometry.h"

#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkDataSetSurfaceFilter.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"
#include "vtkUnstructuredGridGeometryFilter.h"

#include <algorithm>
#include <cmath>
#include <set>
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

/// Number of triangles into which VTK divides the faces of a grid, and their largest distance from
/// the faces.
struct Triangulation
{
  std::size_t Count = 0;
  double Deviation = 0.0;
};

/// Adds the triangles of one face. The distance is measured at the centers of their edges.
void Measure(vtkCell* face, Triangulation& result)
{
  vtkNew<vtkIdList> ids;
  vtkNew<vtkPoints> corners;
  face->Triangulate(0, ids, corners);
  result.Count += static_cast<std::size_t>(ids->GetNumberOfIds() / 3);
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
    const vtkIdType next = i % 3 == 2 ? i - 2 : i + 1;
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
    if (face->GetCellDimension() == 2)
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

}

vtkSmartPointer<vtkPolyData> ExtractCurvedSurface(
  vtkDataSet* data, const char* cellIds, const ProgressCallback& progress)
{
  auto* grid = vtkUnstructuredGridBase::SafeDownCast(data);
  if (!grid || !HasCurvedCells(grid))
  {
    return nullptr;
  }
  vtkNew<vtkUnstructuredGridGeometryFilter> faces;
  faces->SetInputData(grid);
  if (cellIds)
  {
    faces->PassThroughCellIdsOn();
    faces->SetOriginalCellIdsName(cellIds);
  }
  faces->MergingOff();
  UpdateStoppably(faces, progress);
  auto* cells = vtkUnstructuredGrid::SafeDownCast(faces->GetOutputDataObject(0));
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputData(cells);
  surface->SetNonlinearSubdivisionLevel(FindLevel(cells, progress));
  surface->PassThroughCellIdsOn();
  surface->SetOriginalCellIdsName(CurvedFaceIds);
  UpdateStoppably(surface, progress);
  return surface->GetOutput();
}

}
