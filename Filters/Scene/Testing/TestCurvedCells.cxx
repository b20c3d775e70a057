// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/CurvedCells.h"
#include "Tessellation/SceneExtractionItem.h"
#include "Tessellation/SceneExtractionSegments.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellTypeSource.h"
#include "vtkDataArray.h"
#include "vtkDataSetSurfaceFilter.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkLagrangeHexahedron.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTriangle.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkUnstructuredGridGeometryFilter.h"
#include "vtkVersionMacros.h"

#include <gtest/gtest.h>

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

using namespace penumbra;

namespace
{

void AddCell(vtkUnstructuredGrid* grid, int type, const std::vector<glm::dvec3>& corners)
{
  if (!grid->GetPoints())
  {
    grid->SetPoints(vtkNew<vtkPoints>());
  }
  vtkNew<vtkIdList> ids;
  for (const glm::dvec3& x : corners)
  {
    ids->InsertNextId(grid->GetPoints()->InsertNextPoint(x.x, x.y, x.z));
  }
  grid->InsertNextCell(type, ids);
}

/// Adds a square of side 2 whose sides bulge outward by `bulge`.
void AddSquare(vtkUnstructuredGrid* grid, int type, double bulge)
{
  const double b = 1.0 + bulge;
  std::vector<glm::dvec3> x = { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 },
    { 0, -b, 0 }, { b, 0, 0 }, { 0, b, 0 }, { -b, 0, 0 } };
  if (type == VTK_BIQUADRATIC_QUAD)
  {
    x.emplace_back(0.0);
  }
  AddCell(grid, type, x);
}

/// Adds a cube of side 2 around `center` with the points in the middle of its edges moved away from
/// the center by the factor `bulge`.
void AddCube(vtkUnstructuredGrid* grid, glm::dvec3 center, double bulge)
{
  std::vector<glm::dvec3> x = { { -1, -1, -1 }, { 1, -1, -1 }, { 1, 1, -1 }, { -1, 1, -1 },
    { -1, -1, 1 }, { 1, -1, 1 }, { 1, 1, 1 }, { -1, 1, 1 } };
  const int edges[12][2] = { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 }, { 4, 5 }, { 5, 6 }, { 6, 7 },
    { 7, 4 }, { 0, 4 }, { 1, 5 }, { 2, 6 }, { 3, 7 } };
  for (const auto& edge : edges)
  {
    x.push_back(0.5 * bulge * (x[edge[0]] + x[edge[1]]));
  }
  for (glm::dvec3& p : x)
  {
    p += center;
  }
  AddCell(grid, VTK_QUADRATIC_HEXAHEDRON, x);
}

double ComputeArea(vtkPolyData* surface)
{
  double area = 0.0;
  vtkNew<vtkIdList> cell;
  for (vtkIdType i = 0; i < surface->GetNumberOfPolys(); ++i)
  {
    surface->GetPolys()->GetCellAtId(i, cell);
    glm::dvec3 x[3];
    for (int k = 0; k < 3; ++k)
    {
      surface->GetPoint(cell->GetId(k), &x[k].x);
    }
    area += vtkTriangle::TriangleArea(&x[0].x, &x[1].x, &x[2].x);
  }
  return area;
}

/// Bends a grid.
void Bend(vtkPoints* points)
{
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    glm::dvec3 x;
    points->GetPoint(i, &x.x);
    x += 0.1 * glm::dvec3(std::sin(2.0 * x.y), std::sin(1.7 * x.z), std::sin(1.3 * x.x));
    points->SetPoint(i, x.x, x.y, x.z);
  }
}

/// Compares the outer faces of a grid with those that VTK finds.
void ExpectFacesOfVTK(vtkUnstructuredGrid* grid)
{
  const vtkSmartPointer<vtkPolyData> surface = ExtractCurvedSurface(grid, "Ids");
  ASSERT_TRUE(surface);
  vtkNew<vtkUnstructuredGridGeometryFilter> faces;
  faces->SetInputData(grid);
  faces->MergingOff();
  vtkNew<vtkDataSetSurfaceFilter> triangles;
  triangles->SetInputConnection(faces->GetOutputPort());
  triangles->SetNonlinearSubdivisionLevel(4);
  triangles->Update();
  vtkDataArray* ids = surface->GetCellData()->GetArray(CurvedFaceIds);
  std::set<double> found;
  for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i)
  {
    found.insert(ids->GetComponent(i, 0));
  }
  auto* cells = vtkUnstructuredGrid::SafeDownCast(faces->GetOutputDataObject(0));
  EXPECT_EQ(static_cast<vtkIdType>(found.size()), cells->GetNumberOfCells());
  const double area = ComputeArea(triangles->GetOutput());
  EXPECT_GT(area, 0.0);
  EXPECT_NEAR(ComputeArea(surface), area, 2e-3 * area);
}

std::vector<LineSegment> FindEdges(vtkPolyData* surface)
{
  DrawItem item;
  item.Data = surface;
  return CollectEdges(item);
}

}

TEST(CurvedCells, AreSubdividedToTheTolerance)
{
  for (const int type : { VTK_QUADRATIC_QUAD, VTK_BIQUADRATIC_QUAD })
  {
    vtkNew<vtkUnstructuredGrid> grid;
    AddSquare(grid, type, 0.5);
    const vtkSmartPointer<vtkPolyData> surface = ExtractCurvedSurface(grid, "Ids");
    ASSERT_TRUE(surface);
    // Below each side is a segment of a parabola with the area 2/3 * 2 * 0.5.
    EXPECT_NEAR(ComputeArea(surface), 4.0 + 4.0 * 2.0 / 3.0, 1e-3) << type;
  }
}

// vtkDataSetSurfaceFilter of VTK 9.2 crashes when it subdivides lines.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
TEST(CurvedCells, LinesAreSubdividedToTheTolerance)
{
  vtkNew<vtkUnstructuredGrid> grid;
  AddCell(grid, VTK_QUADRATIC_EDGE, { { -1, 0, 0 }, { 1, 0, 0 }, { 0, 0.5, 0 } });
  const vtkSmartPointer<vtkPolyData> lines = ExtractCurvedSurface(grid, "Ids");
  ASSERT_TRUE(lines);
  double length = 0.0;
  vtkNew<vtkIdList> line;
  for (vtkIdType cell = 0; cell < lines->GetNumberOfLines(); ++cell)
  {
    lines->GetLines()->GetCellAtId(cell, line);
    for (vtkIdType i = 0; i < line->GetNumberOfIds(); ++i)
    {
      glm::dvec3 a;
      lines->GetPoint(line->GetId(i), &a.x);
      EXPECT_NEAR(a.y, 0.5 - 0.5 * a.x * a.x, 1e-6);
      if (i > 0)
      {
        glm::dvec3 b;
        lines->GetPoint(line->GetId(i - 1), &b.x);
        length += glm::distance(a, b);
      }
    }
  }
  // Arc length of y = 0.5 x^2 between -1 and 1.
  EXPECT_NEAR(length, std::sqrt(2.0) + std::asinh(1.0), 1e-3);
}
#endif

TEST(CurvedCells, HaveTheEdgesOfTheCellsAsCurves)
{
  vtkNew<vtkUnstructuredGrid> grid;
  AddSquare(grid, VTK_QUADRATIC_QUAD, 0.5);
  const vtkSmartPointer<vtkPolyData> surface = ExtractCurvedSurface(grid, "Ids");
  const std::vector<LineSegment> edges = FindEdges(surface);
  EXPECT_GE(edges.size(), 4u * 32u);
  double length = 0.0;
  for (const LineSegment& edge : edges)
  {
    glm::dvec3 a;
    glm::dvec3 b;
    surface->GetPoint(edge.From, &a.x);
    surface->GetPoint(edge.To, &b.x);
    length += glm::distance(a, b);
    const double u = std::min(std::abs(a.x), std::abs(a.y));
    const double v = std::max(std::abs(a.x), std::abs(a.y));
    EXPECT_NEAR(v, 1.5 - 0.5 * u * u, 1e-6);
  }
  // Arc length of y = 0.5 x^2 between -1 and 1.
  EXPECT_NEAR(length, 4.0 * (std::sqrt(2.0) + std::asinh(1.0)), 2e-3);
}

TEST(CurvedCells, HaveNoEdgesWithinFaces)
{
  vtkNew<vtkUnstructuredGrid> grid;
  AddCube(grid, glm::dvec3(0.0), 1.35);
  const vtkSmartPointer<vtkPolyData> curved = ExtractCurvedSurface(grid, "Ids");
  const std::size_t perEdge = FindEdges(curved).size() / 12;
  EXPECT_EQ(FindEdges(curved).size(), 12 * perEdge);
  EXPECT_GE(perEdge, 16u);
  EXPECT_EQ(perEdge & (perEdge - 1), 0u); // a power of two
  for (const LineSegment& edge : FindEdges(curved))
  {
    // Each edge lies in a plane through the center and two opposite edges.
    glm::dvec3 a;
    curved->GetPoint(edge.From, &a.x);
    const glm::dvec3 d = glm::abs(a);
    EXPECT_LT(std::min({ std::abs(d.x - d.y), std::abs(d.y - d.z), std::abs(d.z - d.x) }), 1e-6);
  }
  // Straight edges need no more than their three points; two cells share no edges in space.
  vtkNew<vtkUnstructuredGrid> flat;
  AddCube(flat, glm::dvec3(0.0), 1.0);
  AddCube(flat, { 2.0, 0.0, 0.0 }, 1.0);
  EXPECT_EQ(FindEdges(ExtractCurvedSurface(flat, "Ids")).size(), 2u * 12u * 2u);
}

TEST(CurvedCells, KeepTheIdsOfCells)
{
  vtkNew<vtkUnstructuredGrid> grid;
  AddCell(grid, VTK_TRIANGLE, { { 9, 9, 9 }, { 10, 9, 9 }, { 9, 10, 9 } });
  AddCube(grid, glm::dvec3(0.0), 1.35);
  AddCube(grid, { 4.0, 0.0, 0.0 }, 1.35);
  const vtkSmartPointer<vtkPolyData> surface = ExtractCurvedSurface(grid, "Ids");
  vtkDataArray* ids = surface->GetCellData()->GetArray("Ids");
  ASSERT_TRUE(ids);
  vtkNew<vtkIdList> cell;
  for (vtkIdType i = 0; i < surface->GetNumberOfPolys(); ++i)
  {
    surface->GetPolys()->GetCellAtId(i, cell);
    const double x = surface->GetPoint(cell->GetId(0))[0];
    EXPECT_EQ(ids->GetComponent(i, 0), x > 8.0 ? 0.0 : x > 2.0 ? 2.0 : 1.0);
  }
}

TEST(CurvedCells, AreLeftToOtherFiltersIfThereAreNone)
{
  vtkNew<vtkUnstructuredGrid> grid;
  AddCell(grid, VTK_TRIANGLE, { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } });
  EXPECT_FALSE(ExtractCurvedSurface(grid, "Ids"));
  EXPECT_FALSE(ExtractCurvedSurface(vtkNew<vtkPolyData>(), "Ids"));
}

TEST(CurvedCells, HaveTheOuterFacesThatVTKFinds)
{
  for (const int type :
    { VTK_QUADRATIC_HEXAHEDRON, VTK_TRIQUADRATIC_HEXAHEDRON, VTK_QUADRATIC_TETRA,
      VTK_QUADRATIC_WEDGE, VTK_QUADRATIC_PYRAMID, VTK_QUADRATIC_QUAD, VTK_LAGRANGE_HEXAHEDRON,
      VTK_LAGRANGE_TETRAHEDRON, VTK_LAGRANGE_WEDGE, VTK_LAGRANGE_TRIANGLE })
  {
    SCOPED_TRACE(type);
    vtkNew<vtkCellTypeSource> source;
    source->SetCellType(type);
    source->SetCellOrder(3);
    source->SetBlocksDimensions(3, 2, 2);
    source->Update();
    vtkUnstructuredGrid* grid = source->GetOutput();
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0)
    if (grid->GetCellType(0) != type)
    {
      continue; // the source makes hexahedra instead
    }
#endif
    Bend(grid->GetPoints());
    ExpectFacesOfVTK(grid);
  }
}

TEST(CurvedCells, HaveNoFacesOfGhosts)
{
  vtkNew<vtkCellTypeSource> source;
  source->SetCellType(VTK_QUADRATIC_HEXAHEDRON);
  source->SetBlocksDimensions(2, 1, 1);
  source->Update();
  vtkUnstructuredGrid* grid = source->GetOutput();
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->InsertNextValue(vtkDataSetAttributes::DUPLICATECELL);
  ghosts->InsertNextValue(0);
  grid->GetCellData()->AddArray(ghosts);
  // Neither the five faces of the ghost nor the one between the cells: five squares of side 1.
  EXPECT_NEAR(ComputeArea(ExtractCurvedSurface(grid, "Ids")), 5.0, 1e-6);
}

TEST(CurvedCells, HaveFacesOfDifferentDegrees)
{
  const int order[3] = { 1, 2, 4 };
  std::vector<glm::dvec3> x(2 * 3 * 5);
  for (int k = 0; k <= order[2]; ++k)
  {
    for (int j = 0; j <= order[1]; ++j)
    {
      for (int i = 0; i <= order[0]; ++i)
      {
        x[vtkLagrangeHexahedron::PointIndexFromIJK(i, j, k, order)] = { 1.0 * i, 0.5 * j,
          0.25 * k };
      }
    }
  }
  vtkNew<vtkUnstructuredGrid> grid;
  AddCell(grid, VTK_LAGRANGE_HEXAHEDRON, x);
  Bend(grid->GetPoints());
  vtkNew<vtkDoubleArray> degrees;
  degrees->SetName("Degrees");
  degrees->SetNumberOfComponents(3);
  degrees->InsertNextTuple3(order[0], order[1], order[2]);
  grid->GetCellData()->SetHigherOrderDegrees(degrees);
  ExpectFacesOfVTK(grid);
}
