// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares baked values with closed forms, and tests inputs and settings of the filter.
#include "vtkPenumbraIrradianceFilter.h"

#include "ClosedForms/FalloffOcclusion.h"
#include "Gathering/Gatherer.h"
#include "Scenes/Adversaries.h"

#include "vtkAppendFilter.h"
#include "vtkAppendPolyData.h"
#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkContourFilter.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPenumbraEnvironment.h"
#include "vtkPenumbraGatherer.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRTAnalyticSource.h"
#include "vtkReverseSense.h"
#include "vtkSphereSource.h"
#include "vtkStructuredGrid.h"
#include "vtkTetra.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace
{

/// Returns a square with sides of 12 and normals.
vtkSmartPointer<vtkPlaneSource> MakeFloor(int side)
{
  auto floor = vtkSmartPointer<vtkPlaneSource>::New();
  floor->SetOrigin(-6.0, -6.0, 0.0);
  floor->SetPoint1(6.0, -6.0, 0.0);
  floor->SetPoint2(-6.0, 6.0, 0.0);
  floor->SetResolution(side, side);
  floor->Update();
  return floor;
}

/// Returns a unit sphere with normals that touches the floor.
vtkSmartPointer<vtkSphereSource> MakeSphere()
{
  auto sphere = vtkSmartPointer<vtkSphereSource>::New();
  sphere->SetRadius(1.0);
  sphere->SetCenter(0.0, 0.0, 1.0);
  sphere->SetThetaResolution(64);
  sphere->SetPhiResolution(64);
  sphere->Update();
  return sphere;
}

vtkSmartPointer<vtkPolyData> MakeSphereOnFloor(int side)
{
  vtkNew<vtkAppendPolyData> append;
  append->AddInputData(MakeFloor(side)->GetOutput());
  append->AddInputData(MakeSphere()->GetOutput());
  append->Update();
  return append->GetOutput();
}

/// Returns the RMSE over the points of the floor. The sphere occludes (1 + rho^2)^(-3/2).
double ComputeFloorRmse(vtkPointSet* baked)
{
  vtkDataArray* values = baked->GetPointData()->GetArray("AmbientOcclusion");
  double square = 0.0;
  vtkIdType count = 0;
  for (vtkIdType i = 0; i < baked->GetNumberOfPoints(); ++i)
  {
    double x[3];
    baked->GetPoint(i, x);
    if (x[2] == 0.0 && std::hypot(x[0], x[1]) > .1)
    {
      const double reference = std::pow(1.0 + x[0] * x[0] + x[1] * x[1], -1.5);
      square += std::pow(values->GetComponent(i, 0) - reference, 2.0);
      ++count;
    }
  }
  return std::sqrt(square / static_cast<double>(count));
}

double GetStatistic(vtkPenumbraIrradianceFilter* filter, const char* name)
{
  return filter->GetStatistics()->GetArray(name)->GetComponent(0, 0);
}

vtkPolyData* GetPolyData(vtkPenumbraIrradianceFilter* filter)
{
  return vtkPolyData::SafeDownCast(filter->GetOutput());
}

}

TEST(vtkPenumbraIrradianceFilter, MeetsToleranceNextToSphere)
{
  const auto mesh = MakeSphereOnFloor(120);
  for (const double tolerance : { .03, .01 })
  {
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputData(mesh);
    filter->SetTolerance(tolerance);
    filter->SetRadius(VTK_DOUBLE_MAX);
    filter->Update();
    EXPECT_LE(ComputeFloorRmse(GetPolyData(filter)), tolerance);
    EXPECT_LT(GetStatistic(filter, "Cache/Records"), .3 * GetStatistic(filter, "Points/Total"));
    EXPECT_GT(
      GetStatistic(filter, "Points/Interpolated"), .5 * GetStatistic(filter, "Points/Total"));
    EXPECT_LE(filter->GetEstimatedError(), 1.5 * tolerance);
  }
}

TEST(vtkPenumbraIrradianceFilter, MeetsToleranceOnSlivers)
{
  // Contours have arbitrarily thin triangles.
  vtkNew<vtkRTAnalyticSource> wavelet;
  vtkNew<vtkContourFilter> contour;
  contour->SetInputConnection(wavelet->GetOutputPort());
  contour->SetValue(0, 170.0);
  contour->Update();
  const auto bake = [&](int method, double tolerance) {
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputData(contour->GetOutput());
    filter->SetMethod(method);
    filter->SetTolerance(tolerance);
    filter->Update();
    return vtkSmartPointer<vtkDataArray>(
      GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion"));
  };
  const auto reference = bake(vtkPenumbraIrradianceFilter::BRUTE_FORCE, .004);
  for (const double tolerance : { .1, .05, .02 })
  {
    const auto baked = bake(vtkPenumbraIrradianceFilter::AUTOMATIC, tolerance);
    double square = 0.0;
    for (vtkIdType i = 0; i < reference->GetNumberOfTuples(); ++i)
    {
      square += std::pow(baked->GetComponent(i, 0) - reference->GetComponent(i, 0), 2.0);
    }
    EXPECT_LE(std::sqrt(square / static_cast<double>(reference->GetNumberOfTuples())), tolerance);
  }
}

TEST(vtkPenumbraIrradianceFilter, MeetsToleranceByBruteForce)
{
  const auto mesh = MakeSphereOnFloor(40);
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(mesh);
  filter->SetMethod(vtkPenumbraIrradianceFilter::BRUTE_FORCE);
  filter->SetRadius(VTK_DOUBLE_MAX);
  filter->Update();
  EXPECT_LE(ComputeFloorRmse(GetPolyData(filter)), .01);
  EXPECT_EQ(GetStatistic(filter, "Cache/Records"), 0);
}

TEST(vtkPenumbraIrradianceFilter, BlocksOfCompositeDataSetOccludeEachOther)
{
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(0, MakeSphere()->GetOutput());
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, inner);
  blocks->SetBlock(2, MakeFloor(40)->GetOutput());
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(blocks);
  filter->SetRadius(VTK_DOUBLE_MAX);
  filter->Update();
  auto* baked = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_EQ(baked->GetNumberOfBlocks(), 3u);
  EXPECT_EQ(baked->GetBlock(1), nullptr);
  auto* floor = vtkPolyData::SafeDownCast(baked->GetBlock(2));
  EXPECT_LE(ComputeFloorRmse(floor), .01);
  EXPECT_FALSE(
    vtkPolyData::SafeDownCast(blocks->GetBlock(2))->GetPointData()->HasArray("AmbientOcclusion"));
  auto* ball =
    vtkPolyData::SafeDownCast(vtkMultiBlockDataSet::SafeDownCast(baked->GetBlock(0))->GetBlock(0));
  vtkDataArray* values = ball->GetPointData()->GetArray("AmbientOcclusion");
  for (vtkIdType i = 0; i < ball->GetNumberOfPoints(); ++i)
  {
    double x[3];
    ball->GetPoint(i, x);
    const double up = x[2] - 1.0;
    if (up < -.85 && up > -.99)
    {
      // An infinite floor occludes all directions below the horizon.
      EXPECT_NEAR(values->GetComponent(i, 0), (1.0 - up) / 2.0, .06) << up;
    }
  }
  EXPECT_TRUE(baked->GetFieldData()->HasArray("Rays/Total"));
}

TEST(vtkPenumbraIrradianceFilter, SecondInputOccludesWithoutValues)
{
  const auto floor = MakeFloor(40);
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(floor->GetOutput());
  filter->SetInputData(1, MakeSphere()->GetOutput());
  filter->SetRadius(VTK_DOUBLE_MAX);
  filter->Update();
  EXPECT_LE(ComputeFloorRmse(GetPolyData(filter)), .01);
  EXPECT_EQ(GetStatistic(filter, "Points/Total"), floor->GetOutput()->GetNumberOfPoints());
  EXPECT_EQ(GetPolyData(filter)->GetNumberOfPoints(), floor->GetOutput()->GetNumberOfPoints());
}

TEST(vtkPenumbraIrradianceFilter, DefaultRadiusIncludesBoundsOfSecondInput)
{
  // Points without polygons extend the bounds, so that a tenth of the diagonal exceeds the scene.
  vtkNew<vtkPolyData> wide;
  wide->DeepCopy(MakeSphere()->GetOutput());
  wide->GetPoints()->InsertNextPoint(1e4, 0.0, 0.0);
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(MakeFloor(40)->GetOutput());
  filter->SetInputData(1, wide);
  filter->Update();
  EXPECT_LE(ComputeFloorRmse(GetPolyData(filter)), .01);
}

TEST(vtkPenumbraIrradianceFilter, SecondInputReflectsLight)
{
  // Under a large ceiling of albedo 1, reflected light from the horizon comes from all directions.
  vtkNew<vtkPlaneSource> ceiling;
  ceiling->SetOrigin(-6.0, -6.0, 1.0);
  ceiling->SetPoint1(6.0, -6.0, 1.0);
  ceiling->SetPoint2(-6.0, 6.0, 1.0);
  ceiling->Update();
  double values[2];
  for (const int bounces : { 1, 2 })
  {
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputData(MakeFloor(8)->GetOutput());
    filter->SetInputData(1, ceiling->GetOutput());
    filter->SetQuantity(vtkPenumbraIrradianceFilter::IRRADIANCE);
    filter->SetAlbedo(1.0);
    filter->SetBounces(bounces);
    filter->Update();
    auto* irradiance = GetPolyData(filter)->GetPointData()->GetArray("Irradiance");
    values[bounces - 1] = irradiance->GetComponent(40, 0); // the center
  }
  EXPECT_LT(values[0], .3);
  EXPECT_GT(values[1], 1.5 * values[0]);
}

TEST(vtkPenumbraIrradianceFilter, PassesBlocksThatAreNotPointSets)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, image);
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(blocks);
  filter->Update();
  auto* baked = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  EXPECT_TRUE(vtkImageData::SafeDownCast(baked->GetBlock(0)));
}

TEST(vtkPenumbraIrradianceFilter, IsIndependentOfThreadCount)
{
  const auto mesh = MakeSphereOnFloor(30);
  vtkSmartPointer<vtkDataArray> first;
  for (const int threads : { 1, 3 })
  {
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputData(mesh);
    filter->SetNumberOfThreads(threads);
    filter->SetTolerance(.05);
    filter->Update();
    vtkDataArray* values = GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion");
    if (!first)
    {
      first = values;
      continue;
    }
    for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
    {
      ASSERT_EQ(values->GetComponent(i, 0), first->GetComponent(i, 0));
    }
  }
}

TEST(vtkPenumbraIrradianceFilter, IsExactOnPlaneAndInsideClosedSphere)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(20, 20);
  vtkNew<vtkSphereSource> inside;
  inside->SetThetaResolution(20);
  inside->SetPhiResolution(20);
  inside->Update();
  vtkDataArray* normals = inside->GetOutput()->GetPointData()->GetNormals();
  for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
  {
    const double* n = normals->GetTuple3(i);
    normals->SetTuple3(i, -n[0], -n[1], -n[2]);
  }
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetRadius(VTK_DOUBLE_MAX);
  filter->SetInputConnection(plane->GetOutputPort());
  filter->Update();
  double range[2];
  GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion")->GetRange(range);
  EXPECT_EQ(range[1], 0.0);
  filter->SetInputData(inside->GetOutput());
  filter->Update();
  GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion")->GetRange(range);
  EXPECT_EQ(range[0], 1.0);
}

TEST(vtkPenumbraIrradianceFilter, SetsZeroAtUnusedAndNonFinitePoints)
{
  vtkNew<vtkPolyData> mesh;
  mesh->DeepCopy(MakeSphereOnFloor(10));
  const vtkIdType unused = mesh->GetPoints()->InsertNextPoint(0.0, 0.0, .01);
  mesh->GetPoints()->SetPoint(0, std::nan(""), 0.0, 0.0);
  vtkNew<vtkFloatArray> normals;
  normals->DeepCopy(mesh->GetPointData()->GetNormals());
  normals->InsertNextTuple3(0.0, 0.0, 1.0);
  mesh->GetPointData()->SetNormals(normals);
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(mesh);
  vtkNew<vtkCallbackCommand> quiet;
  filter->AddObserver(vtkCommand::WarningEvent, quiet);
  filter->Update();
  vtkDataArray* values = GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion");
  ASSERT_EQ(values->GetNumberOfTuples(), mesh->GetNumberOfPoints());
  EXPECT_EQ(values->GetComponent(unused, 0), 0.0);
  EXPECT_EQ(values->GetComponent(0, 0), 0.0);
  EXPECT_EQ(GetStatistic(filter, "Points/Unused"), 1);
  EXPECT_EQ(GetStatistic(filter, "Points/NotFinite"), 1);
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    ASSERT_TRUE(std::isfinite(values->GetComponent(i, 0)));
  }
}

TEST(vtkPenumbraIrradianceFilter, ComputesNormalsIfArrayIsTooShort)
{
  const auto mesh = MakeSphereOnFloor(10);
  vtkNew<vtkPenumbraIrradianceFilter> computing;
  computing->SetInputData(mesh);
  computing->ComputeNormalsOn();
  computing->Update();
  const auto expected = GetPolyData(computing)->GetPointData()->GetArray("AmbientOcclusion");
  vtkNew<vtkPolyData> faulty;
  faulty->ShallowCopy(mesh);
  vtkNew<vtkFloatArray> few;
  few->SetNumberOfComponents(3);
  few->InsertNextTuple3(0.0, 0.0, -1.0);
  faulty->GetPointData()->SetNormals(few);
  std::string warnings;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&warnings);
  observer->SetCallback([](vtkObject*, unsigned long, void* to, void* text) {
    *static_cast<std::string*>(to) += static_cast<const char*>(text);
  });
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(faulty);
  filter->AddObserver(vtkCommand::WarningEvent, observer);
  filter->Update();
  const auto values = GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion");
  ASSERT_EQ(values->GetNumberOfTuples(), expected->GetNumberOfTuples());
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    EXPECT_EQ(values->GetComponent(i, 0), expected->GetComponent(i, 0)) << i;
  }
  EXPECT_NE(warnings.find("1 normals of points"), std::string::npos) << warnings;
}

TEST(vtkPenumbraIrradianceFilter, OrientsPolygonsAroundCrowdedPointConsistently)
{
  const vtkSmartPointer<vtkPolyData> fan = penumbra::FindAdversary("Fan")->Make(1500);
  vtkNew<vtkPolyData> mixed;
  mixed->DeepCopy(fan);
  for (vtkIdType cell = 1; cell < fan->GetNumberOfCells(); cell += 1 + cell % 3)
  {
    mixed->GetPolys()->ReverseCellAtId(cell);
  }
  const auto bake = [](vtkPolyData* mesh) {
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputData(mesh);
    filter->Update();
    vtkDataArray* baked = GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion");
    std::vector<double> values;
    for (vtkIdType i = 0; baked && i < baked->GetNumberOfTuples(); ++i)
    {
      values.push_back(baked->GetTuple1(i));
    }
    return values;
  };
  const std::vector<double> expected = bake(fan);
  const std::vector<double> found = bake(mixed);
  ASSERT_EQ(found.size(), 1501u);
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    EXPECT_NEAR(found[i], expected[i], 0.02) << i;
  }
}

TEST(vtkPenumbraIrradianceFilter, IgnoresNonFiniteOccluders)
{
  for (int bad = 0; bad < 3; ++bad)
  {
    // With the invalid corner at the center of the floor, the triangle would cover much of it.
    vtkNew<vtkPoints> points;
    points->InsertNextPoint(-5.0, -5.0, 2.0);
    points->InsertNextPoint(5.0, -5.0, 2.0);
    points->InsertNextPoint(0.0, 5.0, 2.0);
    points->SetPoint(bad, std::nan(""), 0.0, 0.0);
    vtkNew<vtkCellArray> triangle;
    triangle->InsertNextCell({ 0, 1, 2 });
    vtkNew<vtkPolyData> surroundings;
    surroundings->SetPoints(points);
    surroundings->SetPolys(triangle);
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputData(MakeFloor(10)->GetOutput());
    filter->SetInputData(1, surroundings);
    filter->SetRadius(VTK_DOUBLE_MAX);
    filter->Update();
    double range[2];
    GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion")->GetRange(range);
    EXPECT_EQ(range[1], 0.0) << bad;
  }
}

TEST(vtkPenumbraIrradianceFilter, BakesCellsAndUnstructuredGrids)
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

TEST(vtkPenumbraIrradianceFilter, MatchesClosedFormOnCellsOfVolumes)
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

TEST(vtkPenumbraIrradianceFilter, MatchesClosedFormOnPointsOfVolumes)
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

TEST(vtkPenumbraIrradianceFilter, BakesSmallVolumes)
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

TEST(vtkPenumbraIrradianceFilter, OrientsSurfacesOfVolumesOutward)
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

TEST(vtkPenumbraIrradianceFilter, WarnsIfAllPointsAreOccluded)
{
  const auto warningOf = [](bool inwards) {
    vtkNew<vtkReverseSense> reversed;
    reversed->SetInputData(MakeSphere()->GetOutput());
    reversed->SetReverseNormals(inwards);
    reversed->SetReverseCells(inwards);
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputConnection(reversed->GetOutputPort());
    filter->SetRadius(VTK_DOUBLE_MAX);
    std::string message;
    vtkNew<vtkCallbackCommand> observer;
    observer->SetClientData(&message);
    observer->SetCallback([](vtkObject*, unsigned long, void* to, void* text) {
      *static_cast<std::string*>(to) += static_cast<const char*>(text);
    });
    filter->AddObserver(vtkCommand::WarningEvent, observer);
    filter->Update();
    return message;
  };
  EXPECT_EQ(warningOf(false), "");
  EXPECT_NE(warningOf(true).find("vtkReverseSense"), std::string::npos);
}

TEST(vtkPenumbraIrradianceFilter, RepresentsPointsByDiscs)
{
  vtkNew<vtkPolyData> cloud;
  cloud->DeepCopy(MakeSphereOnFloor(80));
  cloud->SetPolys(vtkNew<vtkCellArray>());
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(cloud);
  filter->SetRadius(VTK_DOUBLE_MAX);
  filter->SetPointRadius(.11);
  filter->Update();
  // The corners of the discs lie slightly outside of the sphere.
  EXPECT_LE(ComputeFloorRmse(GetPolyData(filter)), .04);
}

TEST(vtkPenumbraIrradianceFilter, AddsNoArrayIfAborted)
{
  const auto mesh = MakeSphereOnFloor(60);
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(mesh);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*) {
    static_cast<vtkPenumbraIrradianceFilter*>(caller)->SetAbortExecute(1);
  });
  filter->AddObserver(vtkCommand::ProgressEvent, abort);
  filter->Update();
  EXPECT_FALSE(GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion"));
}

namespace
{

/// Counts the calls of Make(), before which nothing can be gathered.
class CountingGatherer : public vtkPenumbraGatherer
{
public:
  static CountingGatherer* New();
  vtkTypeMacro(CountingGatherer, vtkPenumbraGatherer);
  std::unique_ptr<penumbra::Gatherer> Make(const penumbra::RayGatherer&) override
  {
    ++this->Made;
    return nullptr;
  }
  void Report(vtkFieldData*) const override {}
  int Made = 0;
};
vtkStandardNewMacro(CountingGatherer);

}

TEST(vtkPenumbraIrradianceFilter, StopsWithinOneProgressEvent)
{
  struct Watch
  {
    double StopAt;
    int Later = -1; ///< number of events after the request to stop
  };
  const auto mesh = MakeSphereOnFloor(4);
  for (const int quantity :
    { vtkPenumbraIrradianceFilter::AMBIENT_OCCLUSION, vtkPenumbraIrradianceFilter::IRRADIANCE })
  {
    for (const double stopAt : { 0.0, .02, .3, .6 })
    {
      Watch watch{ stopAt };
      vtkNew<vtkCallbackCommand> observer;
      observer->SetClientData(&watch);
      observer->SetCallback([](vtkObject* caller, unsigned long, void* data, void*) {
        auto& self = *static_cast<Watch*>(data);
        auto* filter = static_cast<vtkPenumbraIrradianceFilter*>(caller);
        if (self.Later >= 0 || filter->GetProgress() >= self.StopAt)
        {
          ++self.Later;
          filter->SetAbortExecute(1);
        }
      });
      vtkNew<CountingGatherer> gatherer;
      vtkNew<vtkPenumbraIrradianceFilter> filter;
      filter->SetInputData(mesh);
      filter->SetQuantity(quantity);
      filter->SetTolerance(.3);
      filter->SetGatherer(gatherer);
      filter->AddObserver(vtkCommand::ProgressEvent, observer);
      filter->Update();
      EXPECT_GE(watch.Later, 0) << stopAt;
      EXPECT_LE(watch.Later, 1) << stopAt; // the final event that VTK sends
      EXPECT_EQ(GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion"), nullptr)
        << stopAt;
      EXPECT_EQ(GetPolyData(filter)->GetPointData()->GetArray("Irradiance"), nullptr) << stopAt;
      EXPECT_EQ(filter->GetStatistics()->GetNumberOfArrays(), 0) << stopAt;
      EXPECT_TRUE(gatherer->Made == 0 || stopAt > 0.0) << stopAt;
    }
  }
}

TEST(vtkPenumbraIrradianceFilter, AcceptsEmptyMesh)
{
  vtkNew<vtkPolyData> empty;
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(empty);
  filter->Update();
  EXPECT_EQ(GetPolyData(filter)->GetNumberOfPoints(), 0);
  EXPECT_EQ(filter->GetEstimatedError(), 0.0);
}

TEST(vtkPenumbraIrradianceFilter, MatchesClosedFormWithFalloff)
{
  vtkNew<vtkPlaneSource> ceiling;
  ceiling->SetOrigin(-20.0, -20.0, .6);
  ceiling->SetPoint1(20.0, -20.0, .6);
  ceiling->SetPoint2(-20.0, 20.0, .6);
  ceiling->Update();
  for (int falloff = 0; falloff < 4; ++falloff)
  {
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputData(MakeFloor(40)->GetOutput());
    filter->SetInputData(1, ceiling->GetOutput());
    filter->SetRadius(2.0);
    filter->SetFalloff(falloff);
    filter->Update();
    vtkDataArray* values = GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion");
    const double reference =
      penumbra::FadingOcclusion{ 2.0, penumbra::PowersOfFalloffs[falloff] }.UnderCeiling(.6);
    double square = 0.0;
    for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
    {
      square += std::pow(values->GetComponent(i, 0) - reference, 2.0);
    }
    EXPECT_LE(std::sqrt(square / static_cast<double>(values->GetNumberOfTuples())), .01) << falloff;
  }
}

TEST(vtkPenumbraIrradianceFilter, MatchesClosedFormWithEnvironmentMapAndSun)
{
  vtkNew<vtkImageData> sky; // 1 above, 0 below, and a sun around the zenith
  constexpr int Rows = 180;
  sky->SetDimensions(1, Rows, 1);
  sky->AllocateScalars(VTK_FLOAT, 1);
  for (int row = 0; row < Rows; ++row)
  {
    sky->SetScalarComponentFromDouble(0, row, 0, 0, row == Rows - 1 ? 1e4 : row < Rows / 2 ? 0 : 1);
  }
  vtkNew<vtkPenumbraEnvironment> environment;
  environment->SetImage(sky);
  environment->SetUp(0.0, 0.0, 1.0);
  const double sun = (1e4 - 1.0) * vtkMath::Pi() * std::pow(std::sin(vtkMath::Pi() / Rows), 2.0);
  for (const int method :
    { vtkPenumbraIrradianceFilter::AUTOMATIC, vtkPenumbraIrradianceFilter::BRUTE_FORCE })
  {
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputData(MakeFloor(20)->GetOutput());
    filter->SetQuantity(vtkPenumbraIrradianceFilter::IRRADIANCE);
    filter->SetMethod(method);
    filter->SetEnvironment(environment);
    filter->Update();
    vtkDataArray* values = GetPolyData(filter)->GetPointData()->GetArray("Irradiance");
    for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
    {
      EXPECT_NEAR(values->GetComponent(i, 0), vtkMath::Pi() + sun, .02);
    }
    const auto before = filter->GetMTime();
    environment->Modified();
    EXPECT_GT(filter->GetMTime(), before);
  }
}

TEST(vtkPenumbraIrradianceFilter, AddsNoArrayIfEnvironmentHasNoImage)
{
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(MakeFloor(4)->GetOutput());
  filter->SetQuantity(vtkPenumbraIrradianceFilter::IRRADIANCE);
  filter->SetEnvironment(vtkNew<vtkPenumbraEnvironment>());
  vtkObject::GlobalWarningDisplayOff();
  filter->Update();
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_FALSE(GetPolyData(filter)->GetPointData()->HasArray("Irradiance"));
}

TEST(vtkPenumbraIrradianceFilter, RejectsNaNSettings)
{
  for (auto set :
    { &vtkPenumbraIrradianceFilter::SetTolerance, &vtkPenumbraIrradianceFilter::SetRadius,
      &vtkPenumbraIrradianceFilter::SetPointRadius, &vtkPenumbraIrradianceFilter::SetAlbedo })
  {
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputConnection(MakeFloor(2)->GetOutputPort());
    (filter.Get()->*set)(std::numeric_limits<double>::quiet_NaN());
    std::string error;
    vtkNew<vtkCallbackCommand> observer;
    observer->SetClientData(&error);
    observer->SetCallback([](vtkObject*, unsigned long, void* heard, void* text) {
      *static_cast<std::string*>(heard) += static_cast<const char*>(text);
    });
    filter->AddObserver(vtkCommand::ErrorEvent, observer);
    filter->Update();
    EXPECT_NE(error.find("must not be NaN"), std::string::npos) << error;
    EXPECT_FALSE(
      vtkPolyData::SafeDownCast(filter->GetOutput())->GetPointData()->HasArray("AmbientOcclusion"));
  }
}
