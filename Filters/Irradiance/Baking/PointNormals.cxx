// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointNormals.h"

#include "Geometry/SurfaceGeometry.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"

#include <algorithm>
#include <tuple>
#include <vector>

namespace penumbra
{
namespace
{

/// Number of cells at one point from which vtkPolyDataNormals, which visits all pairs of neighbors,
/// is too slow.
constexpr vtkIdType CrowdedCellCount = 1024;

bool HasCrowdedPoint(vtkPolyData* mesh)
{
  std::vector<vtkIdType> cells(static_cast<std::size_t>(mesh->GetNumberOfPoints()), 0);
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < mesh->GetPolys()->GetNumberOfCells(); ++cell)
  {
    mesh->GetPolys()->GetCellAtId(cell, ids);
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
    {
      if (++cells[static_cast<std::size_t>(ids->GetId(k))] >= CrowdedCellCount)
      {
        return true;
      }
    }
  }
  return false;
}

/// Returns the polygons with consistent orientation. The first polygon of each connected part keeps
/// its orientation. Edges are sorted, so that points with many cells cost no more than others.
vtkSmartPointer<vtkCellArray> OrientConsistently(vtkCellArray* polygons)
{
  struct Edge
  {
    vtkIdType Low, High, Cell;
    bool Forward;
  };
  struct Link
  {
    vtkIdType From, To;
    bool Opposite;
  };
  const auto oriented = vtkSmartPointer<vtkCellArray>::New();
  oriented->DeepCopy(polygons);
  std::vector<Edge> edges;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < oriented->GetNumberOfCells(); ++cell)
  {
    oriented->GetCellAtId(cell, ids);
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
    {
      const vtkIdType from = ids->GetId(k);
      const vtkIdType to = ids->GetId((k + 1) % ids->GetNumberOfIds());
      edges.push_back({ std::min(from, to), std::max(from, to), cell, from < to });
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.Low, a.High, a.Cell) < std::tie(b.Low, b.High, b.Cell);
  });
  std::vector<Link> links;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i)
  {
    const Edge& a = edges[i];
    const Edge& b = edges[i + 1];
    if (a.Low == b.Low && a.High == b.High && a.Cell != b.Cell)
    {
      links.push_back({ a.Cell, b.Cell, a.Forward == b.Forward });
      links.push_back({ b.Cell, a.Cell, a.Forward == b.Forward });
    }
  }
  const auto before = [](const Link& a, const Link& b) { return a.From < b.From; };
  std::stable_sort(links.begin(), links.end(), before);
  enum : char
  {
    Unseen,
    Kept,
    Reversed
  };
  std::vector<char> states(static_cast<std::size_t>(oriented->GetNumberOfCells()), Unseen);
  std::vector<vtkIdType> stack;
  for (vtkIdType first = 0; first < oriented->GetNumberOfCells(); ++first)
  {
    if (states[first] == Unseen)
    {
      states[first] = Kept;
      stack.push_back(first);
    }
    while (!stack.empty())
    {
      const vtkIdType cell = stack.back();
      stack.pop_back();
      const auto [begin, end] =
        std::equal_range(links.begin(), links.end(), Link{ cell, 0, false }, before);
      for (auto link = begin; link != end; ++link)
      {
        if (states[link->To] == Unseen)
        {
          states[link->To] = (states[cell] == Reversed) != link->Opposite ? Reversed : Kept;
          stack.push_back(link->To);
        }
      }
    }
    // States are final here: a connected part is complete once its first polygon has been
    // processed.
    if (states[first] == Reversed)
    {
      oriented->ReverseCellAtId(first);
    }
  }
  return oriented;
}

}

vtkSmartPointer<vtkDataArray> ComputePointNormals(
  vtkPolyData* surface, const ProgressCallback& progress)
{
  vtkNew<vtkPolyData> polygons;
  polygons->SetPoints(surface->GetPoints());
  polygons->SetPolys(surface->GetPolys());
  polygons->SetStrips(surface->GetStrips());
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(polygons);
  normals->SplittingOff();
  if (surface->GetNumberOfStrips() == 0 && HasCrowdedPoint(polygons))
  {
    polygons->SetPolys(OrientConsistently(polygons->GetPolys()));
    normals->ConsistencyOff();
  }
  else
  {
    normals->ConsistencyOn();
  }
  UpdateStoppably(normals, progress);
  vtkDataArray* pointNormals = normals->GetOutput()->GetPointData()->GetNormals();
  return pointNormals && pointNormals->GetNumberOfTuples() == surface->GetNumberOfPoints()
    ? pointNormals
    : nullptr;
}

}
