// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Inputs of baking: composite data sets, occluders, damaged meshes, points, meshes without normals.
#include "vtkPenumbraIrradianceFilter.h"

#include "Scenes/Adversaries.h"
#include "SphereOnFloor.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace penumbra_testing;

TEST(BakingInputs, BlocksOfCompositeDataSetOccludeEachOther)
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

TEST(BakingInputs, SecondInputOccludesWithoutValues)
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

TEST(BakingInputs, DefaultRadiusIncludesBoundsOfSecondInput)
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

TEST(BakingInputs, SecondInputReflectsLight)
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
    filter->SetInputData(MakeFloor(2)->GetOutput());
    filter->SetInputData(1, ceiling->GetOutput());
    filter->SetQuantity(vtkPenumbraIrradianceFilter::IRRADIANCE);
    filter->SetAlbedo(1.0);
    filter->SetBounces(bounces);
    filter->Update();
    auto* irradiance = GetPolyData(filter)->GetPointData()->GetArray("Irradiance");
    values[bounces - 1] = irradiance->GetComponent(4, 0); // the center
  }
  EXPECT_LT(values[0], .3);
  EXPECT_GT(values[1], 1.5 * values[0]);
}

TEST(BakingInputs, PassesBlocksThatAreNotPointSets)
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

TEST(BakingInputs, SetsZeroAtUnusedAndNonFinitePoints)
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

TEST(BakingInputs, ComputesNormalsIfArrayIsTooShort)
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

TEST(BakingInputs, OrientsPolygonsAroundCrowdedPointConsistently)
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

TEST(BakingInputs, IgnoresNonFiniteOccluders)
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

TEST(BakingInputs, RepresentsPointsByDiscs)
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

/// Returns a strip of unequal triangles: a step of the width 1, whose tread has the length 1 and whose
/// riser has the height 3, and a wall that touches the triangles of the tread.
vtkSmartPointer<vtkPolyData> MakeStrip(bool asTriangles)
{
  const double corners[][3] = { { 0.0, 0.0, 0.0 }, { 0.0, -1.0, 0.0 }, { 1.0, 0.0, 0.0 },
    { 1.0, -1.0, 0.0 }, { 1.0, 0.0, -3.0 }, { 1.0, -1.0, -3.0 }, { -1.0, -.5, 0.0 },
    { 1.0, -.5, 0.0 }, { 1.0, -.5, 2.0 }, { -1.0, -.5, 2.0 } };
  vtkNew<vtkPoints> points;
  for (const double* corner : corners)
  {
    points->InsertNextPoint(corner);
  }
  const auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  vtkNew<vtkCellArray> polygons;
  const vtkIdType wall[] = { 6, 7, 8, 9 };
  polygons->InsertNextCell(4, wall);
  for (vtkIdType i = 0; asTriangles && i < 4; ++i)
  {
    const vtkIdType triangle[] = { i, i + 1 + i % 2, i + 2 - i % 2 };
    polygons->InsertNextCell(3, triangle);
  }
  mesh->SetPolys(polygons);
  vtkNew<vtkCellArray> strips;
  const vtkIdType strip[] = { 0, 1, 2, 3, 4, 5 };
  strips->InsertNextCell(6, strip);
  mesh->SetStrips(asTriangles ? nullptr : strips.Get());
  return mesh;
}

TEST(BakingInputs, ValuesOfStripsAreMeansOfTheirTriangles)
{
  const auto bake = [](vtkPolyData* mesh, int quantity) {
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputData(mesh);
    filter->SetQuantity(quantity);
    filter->SetOnCells(true);
    filter->SetRadius(VTK_DOUBLE_MAX);
    filter->AddLight(0.0, 0.0, 1.0, 0.0);
    filter->SetTolerance(.001);
    filter->Update();
    return vtkSmartPointer<vtkDataArray>(GetPolyData(filter)->GetCellData()->GetArray(0));
  };
  // Only the tread, a quarter of the area, faces the light.
  EXPECT_NEAR(bake(MakeStrip(false), vtkPenumbraIrradianceFilter::DIRECT_LIGHT)->GetComponent(1, 0),
    .25, 1e-5);
  const auto triangles = bake(MakeStrip(true), vtkPenumbraIrradianceFilter::AMBIENT_OCCLUSION);
  double expected = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    expected += (i < 2 ? .125 : .375) * triangles->GetComponent(1 + i, 0);
  }
  EXPECT_GT(triangles->GetComponent(1, 0), triangles->GetComponent(3, 0) + .1);
  EXPECT_NEAR(
    bake(MakeStrip(false), vtkPenumbraIrradianceFilter::AMBIENT_OCCLUSION)->GetComponent(1, 0),
    expected, .003);
}

TEST(BakingInputs, AcceptsEmptyMesh)
{
  vtkNew<vtkPolyData> empty;
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(empty);
  filter->Update();
  EXPECT_EQ(GetPolyData(filter)->GetNumberOfPoints(), 0);
  EXPECT_EQ(filter->GetEstimatedError(), 0.0);
}

TEST(IrradianceFilter, MultipliesOcclusionByOpacity)
{
  const auto bake = [](double opacity, int method) {
    vtkSmartPointer<vtkPlaneSource> floor = MakeFloor(24);
    vtkNew<vtkPlaneSource> wall;
    wall->SetOrigin(-6.0, -1000.0, 0.0);
    wall->SetPoint1(-6.0, 1000.0, 0.0);
    wall->SetPoint2(-6.0, -1000.0, 1000.0);
    wall->Update();
    vtkNew<vtkFloatArray> opacities;
    opacities->SetName("Opacity");
    for (vtkIdType i = 0; i < wall->GetOutput()->GetNumberOfPoints(); ++i)
    {
      opacities->InsertNextValue(static_cast<float>(opacity));
    }
    vtkNew<vtkFloatArray> opaque;
    opaque->SetName("Opacity");
    for (vtkIdType i = 0; i < floor->GetOutput()->GetNumberOfPoints(); ++i)
    {
      opaque->InsertNextValue(1.f);
    }
    wall->GetOutput()->GetPointData()->AddArray(opacities);
    floor->GetOutput()->GetPointData()->AddArray(opaque);
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputData(floor->GetOutput());
    filter->SetInputData(1, wall->GetOutput());
    filter->SetRadius(VTK_DOUBLE_MAX);
    filter->SetTolerance(0.002);
    filter->SetMethod(method);
    filter->SetOpacityArray("Opacity");
    filter->Update();
    vtkDataArray* values = GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion");
    double sum = 0.0;
    int count = 0;
    for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
    {
      double x[3];
      GetPolyData(filter)->GetPoint(i, x);
      if (x[0] > -5.9)
      {
        sum += values->GetComponent(i, 0);
        ++count;
      }
    }
    return sum / count;
  };
  for (const int method :
    { vtkPenumbraIrradianceFilter::AUTOMATIC, vtkPenumbraIrradianceFilter::BRUTE_FORCE })
  {
    EXPECT_NEAR(bake(1.0, method), 0.5, .005);
    for (const double opacity : { 0.0, 0.1, 0.5, 0.9 })
    {
      EXPECT_NEAR(bake(opacity, method), 0.5 * opacity, .005) << opacity;
    }
  }
}

namespace
{

/// Appends the errors of an algorithm and of its executive to `errors`.
void CollectErrors(vtkAlgorithm* algorithm, std::string& errors)
{
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&errors);
  observer->SetCallback([](vtkObject*, unsigned long, void* client, void* text) {
    *static_cast<std::string*>(client) += static_cast<const char*>(text);
  });
  algorithm->AddObserver(vtkCommand::ErrorEvent, observer);
  algorithm->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
}

/// Errors of baking a floor, of one array on the floor itself or on the surroundings.
std::string BakeWithOpacity(vtkAbstractArray* array, bool onSurroundings, bool& hasOutput)
{
  vtkSmartPointer<vtkPlaneSource> floor = MakeFloor(4);
  vtkNew<vtkPlaneSource> wall;
  wall->Update();
  vtkNew<vtkFloatArray> opaque;
  opaque->SetName("Opacity");
  opaque->SetNumberOfTuples(floor->GetOutput()->GetNumberOfPoints());
  opaque->Fill(1.0);
  vtkPolyData* target = onSurroundings ? wall->GetOutput() : floor->GetOutput();
  floor->GetOutput()->GetPointData()->AddArray(opaque);
  target->GetPointData()->RemoveArray("Opacity");
  if (array)
  {
    array->SetName("Opacity");
    target->GetPointData()->AddArray(array);
  }
  std::string errors;
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  CollectErrors(filter, errors);
  filter->SetInputData(floor->GetOutput());
  filter->SetInputData(1, wall->GetOutput());
  filter->SetOpacityArray("Opacity");
  filter->Update();
  hasOutput = GetPolyData(filter)->GetPointData()->HasArray("AmbientOcclusion");
  return errors;
}

}

TEST(IrradianceFilter, RejectsInvalidOpacityArrays)
{
  const auto makeFloats = [](vtkIdType tuples, int components, float value) {
    auto array = vtkSmartPointer<vtkFloatArray>::New();
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(tuples);
    array->Fill(value);
    return array;
  };
  for (const bool onSurroundings : { false, true })
  {
    const vtkIdType points = onSurroundings ? 4 : 25;
    auto words = vtkSmartPointer<vtkStringArray>::New();
    words->SetNumberOfValues(points);
    std::vector<vtkSmartPointer<vtkAbstractArray>> arrays = { makeFloats(points - 1, 1, 0.5f),
      makeFloats(points + 1, 1, 0.5f), makeFloats(points, 3, 0.5f), makeFloats(points, 1, -0.1f),
      makeFloats(points, 1, 1.1f), makeFloats(points, 1, std::nanf("")), words };
    for (const vtkSmartPointer<vtkAbstractArray>& array : arrays)
    {
      bool hasOutput = true;
      const std::string errors = BakeWithOpacity(array, onSurroundings, hasOutput);
      EXPECT_NE(errors.find("OpacityArray: Opacity"), std::string::npos) << errors;
      EXPECT_EQ(errors.find("input port 1") != std::string::npos, onSurroundings) << errors;
      EXPECT_FALSE(hasOutput);
    }
    // Without the array, the surroundings are opaque; that of the input is required.
    bool hasOutput = true;
    const std::string errors = BakeWithOpacity(nullptr, onSurroundings, hasOutput);
    EXPECT_EQ(errors.empty(), onSurroundings) << errors;
    EXPECT_EQ(hasOutput, onSurroundings);
  }
}

TEST(IrradianceFilter, NamesTheRemedyForDataWithoutPoints)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 3, 3);
  vtkNew<vtkTable> table;
  for (vtkDataObject* input :
    { static_cast<vtkDataObject*>(image), static_cast<vtkDataObject*>(table) })
  {
    std::string errors;
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    CollectErrors(filter, errors);
    filter->SetInputData(input);
    filter->Update();
    EXPECT_NE(errors.find(std::string("The input is a ") + input->GetClassName()), errors.npos)
      << errors;
    EXPECT_NE(errors.find("vtkGeometryFilter (Extract Surface in ParaView)"), errors.npos)
      << errors;
  }
}
