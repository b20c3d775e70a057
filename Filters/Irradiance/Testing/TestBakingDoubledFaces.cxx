// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Meshes whose polygons exist twice, facing the same or opposite sides: points have the values of
// the mesh with single polygons.
#include "vtkPenumbraIrradianceFilter.h"

#include "SphereOnFloor.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCubeSource.h"
#include "vtkIdList.h"
#include "vtkPoints.h"
#include "vtkPolyDataNormals.h"
#include "vtkTriangleFilter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace penumbra_testing;

namespace
{

/// Returns a cube that hovers above a floor, in triangles, without normals.
vtkSmartPointer<vtkPolyData> MakeCubeAboveFloor()
{
  vtkNew<vtkCubeSource> cube;
  cube->SetCenter(0.0, 0.0, .6);
  vtkNew<vtkPlaneSource> floor;
  floor->SetOrigin(-2.0, -2.0, 0.0);
  floor->SetPoint1(2.0, -2.0, 0.0);
  floor->SetPoint2(-2.0, 2.0, 0.0);
  floor->SetResolution(16, 16);
  vtkNew<vtkAppendPolyData> append;
  append->AddInputConnection(cube->GetOutputPort());
  append->AddInputConnection(floor->GetOutputPort());
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(append->GetOutputPort());
  triangles->Update();
  const auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(triangles->GetOutput()->GetPoints());
  mesh->SetPolys(triangles->GetOutput()->GetPolys());
  return mesh;
}

enum class Copies
{
  Same,          ///< same points and orientation
  Opposite,      ///< same points, opposite orientation
  Interleaved,   ///< the same, each copy behind its original
  SeparatePoints ///< opposite orientation, with copies of the points
};

/// Returns the mesh with a second copy of each polygon. Copied points are moved against their normal
/// by `depth`.
vtkSmartPointer<vtkPolyData> Double(vtkPolyData* mesh, Copies copies, double depth = 0.0)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(mesh);
  normals->SplittingOff();
  normals->ConsistencyOff();
  normals->Update();
  vtkDataArray* directions = normals->GetOutput()->GetPointData()->GetNormals();
  const vtkIdType count = mesh->GetNumberOfPoints();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < (copies == Copies::SeparatePoints ? 2 : 1) * count; ++i)
  {
    double x[3];
    mesh->GetPoint(i % count, x);
    const double* n = directions->GetTuple3(i % count);
    const double shift = i < count ? 0.0 : depth;
    points->InsertNextPoint(x[0] - shift * n[0], x[1] - shift * n[1], x[2] - shift * n[2]);
  }
  std::vector<std::vector<vtkIdType>> originals;
  std::vector<std::vector<vtkIdType>> doubles;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    mesh->GetPolys()->GetCellAtId(cell, ids);
    originals.emplace_back(ids->GetPointer(0), ids->GetPointer(0) + ids->GetNumberOfIds());
    doubles.push_back(originals.back());
    for (vtkIdType& id : doubles.back())
    {
      id += copies == Copies::SeparatePoints ? count : 0;
    }
    if (copies != Copies::Same)
    {
      std::reverse(doubles.back().begin(), doubles.back().end());
    }
  }
  const auto doubled = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkCellArray> cells;
  const auto insert = [&](const std::vector<vtkIdType>& cell) {
    cells->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  };
  for (std::size_t i = 0; i < originals.size(); ++i)
  {
    insert(originals[i]);
    if (copies == Copies::Interleaved)
    {
      insert(doubles[i]);
    }
  }
  for (std::size_t i = 0; i < doubles.size() && copies != Copies::Interleaved; ++i)
  {
    insert(doubles[i]);
  }
  doubled->SetPoints(points);
  doubled->SetPolys(cells);
  return doubled;
}

struct Baked
{
  vtkSmartPointer<vtkDataArray> Values;
  std::vector<std::string> Warnings;
};

Baked Bake(vtkPolyData* mesh, double tolerance, vtkAlgorithmOutput* surroundings = nullptr)
{
  Baked baked;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&baked.Warnings);
  observer->SetCallback([](vtkObject*, unsigned long, void* warnings, void* text) {
    static_cast<std::vector<std::string>*>(warnings)->emplace_back(static_cast<char*>(text));
  });
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->AddObserver(vtkCommand::WarningEvent, observer);
  filter->SetInputData(mesh);
  if (surroundings)
  {
    filter->SetInputConnection(1, surroundings);
    filter->SetRadius(VTK_DOUBLE_MAX);
  }
  filter->SetTolerance(tolerance);
  filter->Update();
  baked.Values = GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion");
  return baked;
}

void ExpectEqual(vtkDataArray* values, vtkDataArray* reference, double tolerance)
{
  for (vtkIdType i = 0; i < reference->GetNumberOfTuples(); ++i)
  {
    EXPECT_NEAR(values->GetComponent(i, 0), reference->GetComponent(i, 0), tolerance) << i;
  }
}

}

TEST(BakingDoubledFaces, HaveValuesOfSingleFaces)
{
  const auto mesh = MakeCubeAboveFloor();
  const Baked single = Bake(mesh, .004);
  EXPECT_TRUE(single.Warnings.empty());
  for (const Copies copies :
    { Copies::Same, Copies::Opposite, Copies::Interleaved, Copies::SeparatePoints })
  {
    SCOPED_TRACE(static_cast<int>(copies));
    const Baked doubled = Bake(Double(mesh, copies), .004);
    ExpectEqual(doubled.Values, single.Values, .04);
    const bool isAmbiguous = copies == Copies::Opposite || copies == Copies::Interleaved;
    ASSERT_EQ(doubled.Warnings.size(), isAmbiguous ? 1u : 0u);
    if (isAmbiguous)
    {
      const std::string text = std::to_string(mesh->GetNumberOfCells()) + " polygons";
      EXPECT_NE(doubled.Warnings[0].find(text), std::string::npos) << doubled.Warnings[0];
    }
  }
}

TEST(BakingDoubledFaces, ThinShellHasValuesOfSingleFaces)
{
  const auto mesh = MakeCubeAboveFloor();
  const Baked single = Bake(mesh, .004);
  for (const double depth : { 1e-5, 1e-3 })
  {
    const Baked doubled = Bake(Double(mesh, Copies::SeparatePoints, depth), .004);
    EXPECT_TRUE(doubled.Warnings.empty());
    ExpectEqual(doubled.Values, single.Values, .04);
  }
}

TEST(BakingDoubledFaces, PointsWithoutSideHaveMeanOfBothSides)
{
  // Pairs of triangles that share a point and face opposite sides: the mean of 0 below and 1 under
  // a large roof.
  constexpr int Count = 8;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (int i = 0; i < Count; ++i)
  {
    const double y = 2.0 * i - Count;
    const vtkIdType first = points->InsertNextPoint(0.0, y, 0.0);
    points->InsertNextPoint(-1.0, y - .5, 0.0);
    points->InsertNextPoint(-1.0, y + .5, 0.0);
    points->InsertNextPoint(1.0, y - .5, 0.0);
    points->InsertNextPoint(1.0, y + .5, 0.0);
    const vtkIdType up[] = { first, first + 2, first + 1 };
    const vtkIdType down[] = { first, first + 4, first + 3 };
    cells->InsertNextCell(3, up);
    cells->InsertNextCell(3, down);
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  vtkNew<vtkPlaneSource> roof;
  roof->SetOrigin(-1e3, -1e3, 1.0);
  roof->SetPoint1(1e3, -1e3, 1.0);
  roof->SetPoint2(-1e3, 1e3, 1.0);
  for (const bool isReversed : { false, true })
  {
    if (isReversed)
    {
      mesh->GetPolys()->ReverseCellAtId(1);
      mesh->GetPolys()->ReverseCellAtId(0);
    }
    const Baked baked = Bake(mesh, .01, roof->GetOutputPort());
    ASSERT_EQ(baked.Warnings.size(), 1u);
    EXPECT_NE(baked.Warnings[0].find(std::to_string(Count) + " points"), std::string::npos)
      << baked.Warnings[0];
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); i += 5)
    {
      EXPECT_NEAR(baked.Values->GetComponent(i, 0), .5, .02) << i;
    }
  }
}
