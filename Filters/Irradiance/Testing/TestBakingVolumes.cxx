// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Baking onto the cells of meshes, and onto the surfaces of volumetric grids.
#include "vtkPenumbraIrradianceFilter.h"

#include "SphereOnFloor.h"

#include "vtkAppendFilter.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStructuredGrid.h"
#include "vtkTetra.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

using namespace penumbra_testing;

TEST(BakingVolumes, BakesCellsAndUnstructuredGrids)
{
  const auto mesh = MakeSphereOnFloor(24);
  vtkNew<vtkPenumbraIrradianceFilter> cells;
  cells->SetInputData(mesh);
  cells->OnCellsOn();
  cells->SetRadius(VTK_DOUBLE_MAX);
  cells->Update();
  vtkDataArray* values = GetPolyData(cells)->GetCellData()->GetArray("AmbientOcclusion");
  ASSERT_TRUE(values);
  ASSERT_EQ(values->GetNumberOfTuples(), mesh->GetNumberOfCells());
  // The cell at the corner (-5.75, -5.75).
  EXPECT_NEAR(values->GetComponent(0, 0), std::pow(1.0 + 2.0 * 5.75 * 5.75, -1.5), .01);

  vtkNew<vtkAppendFilter> grid;
  grid->AddInputData(mesh);
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputConnection(grid->GetOutputPort());
  filter->SetRadius(VTK_DOUBLE_MAX);
  filter->Update();
  auto* output = vtkUnstructuredGrid::SafeDownCast(filter->GetOutput());
  ASSERT_TRUE(output);
  EXPECT_LE(ComputeFloorRmse(output), .015); // few points near the sphere, where values change most
}

namespace
{

/// Returns a box of `side`^3 unit cells as a structured grid that starts at x = `begin`.
vtkSmartPointer<vtkStructuredGrid> MakeBlock(int side, double begin)
{
  vtkNew<vtkPoints> points;
  for (int k = 0; k <= side; ++k)
  {
    for (int j = 0; j <= side; ++j)
    {
      for (int i = 0; i <= side; ++i)
      {
        points->InsertNextPoint(begin + i, j, k);
      }
    }
  }
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(side + 1, side + 1, side + 1);
  grid->SetPoints(points);
  return grid;
}

vtkSmartPointer<vtkUnstructuredGrid> Append(std::initializer_list<vtkDataSet*> parts)
{
  vtkNew<vtkAppendFilter> append;
  for (vtkDataSet* part : parts)
  {
    append->AddInputData(part);
  }
  append->Update();
  return append->GetOutput();
}

vtkSmartPointer<vtkPointSet> Bake(vtkPointSet* data, bool onCells)
{
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(data);
  filter->SetOnCells(onCells);
  filter->SetRadius(1.0);
  filter->Update();
  return vtkPointSet::SafeDownCast(filter->GetOutput());
}

/// Cuts the cells of `grid` into tetrahedra. If `mirrored` is true, their orientation is inverted.
vtkSmartPointer<vtkUnstructuredGrid> CutIntoTetrahedra(vtkDataSet* grid, bool mirrored)
{
  vtkNew<vtkDataSetTriangleFilter> cut;
  cut->SetInputData(grid);
  cut->Update();
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < cut->GetOutput()->GetNumberOfCells(); ++i)
  {
    cut->GetOutput()->GetCellPoints(i, corners);
    double x[4][3];
    for (int k = 0; k < 4; ++k)
    {
      cut->GetOutput()->GetPoint(corners->GetId(k), x[k]);
    }
    const bool isMirrored = vtkTetra::ComputeVolume(x[0], x[1], x[2], x[3]) < 0.0;
    if (isMirrored != mirrored)
    {
      const vtkIdType first = corners->GetId(0);
      corners->SetId(0, corners->GetId(1));
      corners->SetId(1, first);
    }
    cells->InsertNextCell(corners);
  }
  auto result = vtkSmartPointer<vtkUnstructuredGrid>::New();
  result->SetPoints(cut->GetOutput()->GetPoints());
  result->SetCells(VTK_TETRA, cells);
  return result;
}

}

TEST(BakingVolumes, MatchesClosedFormOnCellsOfVolumes)
{
  // Two blocks with a gap of half a unit: cells that face the gap are occluded, others are not.
  const auto grid = Append({ MakeBlock(10, 0.0), MakeBlock(10, 10.5) });
  const auto baked = Bake(grid, true);
  vtkDataArray* values = baked->GetCellData()->GetArray("AmbientOcclusion");
  ASSERT_TRUE(values);
  int facing = 0;
  for (vtkIdType i = 0; i < baked->GetNumberOfCells(); ++i)
  {
    double bounds[6];
    baked->GetCellBounds(i, bounds);
    const double middle = .5 * (bounds[0] + bounds[1]);
    const bool faces = middle > 9.0 && middle < 11.5;
    facing += faces;
    if (faces)
    {
      EXPECT_GT(values->GetComponent(i, 0), .1) << i;
    }
    else
    {
      EXPECT_LT(values->GetComponent(i, 0), .02) << i;
    }
    const bool deep = bounds[2] > 1.5 && bounds[3] < 8.5 && bounds[4] > 1.5 && bounds[5] < 8.5;
    if (faces && deep)
    {
      // A plane at height h occludes all but (h / R)^2 of the hemisphere.
      EXPECT_NEAR(values->GetComponent(i, 0), 1.0 - .25, .03) << i;
    }
  }
  EXPECT_EQ(facing, 200);
}

TEST(BakingVolumes, MatchesClosedFormOnPointsOfVolumes)
{
  const auto grid = Append({ MakeBlock(10, 0.0), MakeBlock(10, 10.5) });
  const auto baked = Bake(grid, false);
  vtkDataArray* values = baked->GetPointData()->GetArray("AmbientOcclusion");
  ASSERT_TRUE(values);
  for (vtkIdType i = 0; i < baked->GetNumberOfPoints(); ++i)
  {
    double x[3];
    baked->GetPoint(i, x);
    const bool faces = x[0] == 10.0 || x[0] == 10.5;
    const bool middle = x[1] > 1.5 && x[1] < 8.5 && x[2] > 1.5 && x[2] < 8.5;
    if (faces && middle)
    {
      EXPECT_NEAR(values->GetComponent(i, 0), 1.0 - .25, .03) << i;
    }
    else if (!faces)
    {
      EXPECT_LT(values->GetComponent(i, 0), .05) << i;
    }
  }
}

TEST(BakingVolumes, BakesSmallVolumes)
{
  const auto block = MakeBlock(2, 0.0);
  const auto grid = Append({ block });
  for (vtkPointSet* data : { static_cast<vtkPointSet*>(block), static_cast<vtkPointSet*>(grid) })
  {
    for (const bool onCells : { false, true })
    {
      const auto baked = Bake(data, onCells);
      vtkDataArray* values = onCells ? baked->GetCellData()->GetArray("AmbientOcclusion")
                                     : baked->GetPointData()->GetArray("AmbientOcclusion");
      ASSERT_TRUE(values);
      ASSERT_EQ(values->GetNumberOfTuples(), onCells ? 8 : 27);
      EXPECT_LT(values->GetRange(0)[1], .05);
    }
  }
}

TEST(BakingVolumes, OrientsSurfacesOfVolumesOutward)
{
  for (const bool mirrored : { false, true })
  {
    const auto grid = CutIntoTetrahedra(MakeBlock(3, 0.0), mirrored);
    for (const bool onCells : { false, true })
    {
      const auto baked = Bake(grid, onCells);
      vtkDataArray* values = onCells ? baked->GetCellData()->GetArray("AmbientOcclusion")
                                     : baked->GetPointData()->GetArray("AmbientOcclusion");
      ASSERT_TRUE(values);
      EXPECT_LT(values->GetRange(0)[1], .05) << mirrored << onCells;
    }
  }
}
