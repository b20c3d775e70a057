// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointNormals.h"

#include "Geometry/SurfaceGeometry.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkPolygon.h"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

namespace penumbra
{
namespace
{

/// Number of cells at one point from which vtkPolyDataNormals, which visits all pairs of neighbors,
/// is too slow.
constexpr vtkIdType CrowdedCellCount = 1024;

/// Length of the mean normal of the polygons of a point below which they cancel.
constexpr double CancelledNormal = 0.02;

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

/// Returns `polygons` without those that have the same points as an earlier one. Sets `reversed` to
/// the number of these that have the opposite orientation.
vtkSmartPointer<vtkCellArray> RemoveCopies(vtkCellArray* polygons, vtkIdType& reversed)
{
  struct Polygon
  {
    std::uint64_t Sum; ///< of hashes of the points, the same in every order
    vtkIdType Cell;
  };
  reversed = 0;
  std::vector<Polygon> all;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < polygons->GetNumberOfCells(); ++cell)
  {
    polygons->GetCellAtId(cell, ids);
    std::uint64_t sum = 0;
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
    {
      std::uint64_t hash = static_cast<std::uint64_t>(ids->GetId(k)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
      sum += hash * 0xd6e8feb86659fd93u;
    }
    all.push_back({ sum, cell });
  }
  std::sort(all.begin(), all.end(), [](const Polygon& a, const Polygon& b) {
    return std::tie(a.Sum, a.Cell) < std::tie(b.Sum, b.Cell);
  });
  std::vector<char> isCopy(all.size(), 0);
  vtkNew<vtkIdList> earlier;
  bool hasCopies = false;
  for (std::size_t i = 1; i < all.size(); ++i)
  {
    if (all[i].Sum != all[i - 1].Sum)
    {
      continue;
    }
    polygons->GetCellAtId(all[i - 1].Cell, earlier);
    polygons->GetCellAtId(all[i].Cell, ids);
    std::vector<vtkIdType> a(
      earlier->GetPointer(0), earlier->GetPointer(0) + earlier->GetNumberOfIds());
    std::vector<vtkIdType> b(ids->GetPointer(0), ids->GetPointer(0) + ids->GetNumberOfIds());
    const auto start = std::find(b.begin(), b.end(), a.empty() ? -1 : a.front());
    std::rotate(b.begin(), start, b.end());
    const bool isSame = a == b;
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    if (a == b)
    {
      isCopy[static_cast<std::size_t>(all[i].Cell)] = 1;
      reversed += isSame ? 0 : 1;
      hasCopies = true;
    }
  }
  if (!hasCopies)
  {
    return polygons;
  }
  const auto kept = vtkSmartPointer<vtkCellArray>::New();
  for (vtkIdType cell = 0; cell < polygons->GetNumberOfCells(); ++cell)
  {
    if (!isCopy[static_cast<std::size_t>(cell)])
    {
      polygons->GetCellAtId(cell, ids);
      kept->InsertNextCell(ids);
    }
  }
  return kept;
}

/// Sets the normals of points to 0 if those of their polygons nearly cancel.
void ClearCancelledNormals(vtkPolyData* mesh, vtkDataArray* normals)
{
  struct Sum
  {
    double Normal[3] = { 0.0, 0.0, 0.0 };
    double Count = 0.0;
  };
  std::vector<Sum> sums(static_cast<std::size_t>(mesh->GetNumberOfPoints()));
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < mesh->GetPolys()->GetNumberOfCells(); ++cell)
  {
    mesh->GetPolys()->GetCellAtId(cell, ids);
    double n[3] = { 0.0, 0.0, 0.0 };
    vtkPolygon::ComputeNormal(
      mesh->GetPoints(), static_cast<int>(ids->GetNumberOfIds()), ids->GetPointer(0), n);
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
    {
      Sum& sum = sums[static_cast<std::size_t>(ids->GetId(k))];
      vtkMath::Add(sum.Normal, n, sum.Normal);
      sum.Count += vtkMath::Norm(n);
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
  {
    if (sums[i].Count > 0.0 && vtkMath::Norm(sums[i].Normal) < CancelledNormal * sums[i].Count)
    {
      normals->SetTuple3(static_cast<vtkIdType>(i), 0.0, 0.0, 0.0);
    }
  }
}

}

vtkSmartPointer<vtkDataArray> ComputePointNormals(
  vtkPolyData* surface, vtkIdType& doubled, const ProgressCallback& progress)
{
  vtkNew<vtkPolyData> polygons;
  polygons->SetPoints(surface->GetPoints());
  polygons->SetPolys(RemoveCopies(surface->GetPolys(), doubled));
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
  vtkSmartPointer<vtkDataArray> pointNormals = normals->GetOutput()->GetPointData()->GetNormals();
  if (!pointNormals || pointNormals->GetNumberOfTuples() != surface->GetNumberOfPoints())
  {
    return nullptr;
  }
  if (surface->GetNumberOfStrips() == 0)
  {
    ClearCancelledNormals(normals->GetOutput(), pointNormals);
  }
  return pointNormals;
}

}
