// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Import/SceneExtraction.h"
#include "Scene.h"
#include "Surface.h"

#include "Embree/RayScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCubeSource.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkTable.h"
#include "vtkTexture.h"
#include "vtkVolume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace penumbra;

namespace
{

ExtractionOptions Square(int size = 100)
{
  ExtractionOptions options;
  options.Resolution[0] = options.Resolution[1] = size;
  return options;
}

vtkSmartPointer<vtkPolyData> Cube()
{
  vtkNew<vtkCubeSource> cube;
  cube->Update();
  return cube->GetOutput();
}

vtkActor* AddCube(vtkRenderer* renderer)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(Cube());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  return actor;
}

/// Returns four points with the given cells, each a list of point ids.
vtkSmartPointer<vtkPolyData> Polygons(const std::vector<std::vector<vtkIdType>>& cells)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->InsertNextPoint(0.0, 0.0, 0.0);
  points->InsertNextPoint(1.0, 0.0, 0.0);
  points->InsertNextPoint(1.0, 1.0, 0.0);
  points->InsertNextPoint(0.0, 1.0, 0.0);
  vtkNew<vtkCellArray> polygons;
  for (const std::vector<vtkIdType>& cell : cells)
  {
    polygons->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(polygons);
  return data;
}

Scene Extract(vtkDataObject* data)
{
  return ExtractScene(std::vector<vtkDataObject*>{ data }, Square());
}

Hit TracePixel(const Scene& scene, double x, double y)
{
  Ray ray;
  ray.Origin = scene.ViewCamera.RayOrigin({ x, y });
  ray.Direction = scene.ViewCamera.RayDirection({ x, y });
  return RayScene(scene, 1).Intersect(ray);
}

bool Warns(const Scene& scene, const std::string& text)
{
  for (const std::string& warning : scene.Warnings)
  {
    if (warning.find(text) != std::string::npos)
    {
      return true;
    }
  }
  return false;
}

}

TEST(SceneExtraction, IsEmptyWithoutData)
{
  EXPECT_TRUE(ExtractScene(std::vector<vtkDataObject*>(), Square()).Surfaces.empty());
  vtkNew<vtkPolyData> nothing;
  EXPECT_TRUE(Extract(nothing).Surfaces.empty());
  vtkNew<vtkRenderer> renderer;
  const Scene scene = ExtractScene(renderer, Square());
  EXPECT_TRUE(scene.Surfaces.empty());
  EXPECT_TRUE(scene.Warnings.empty());
  EXPECT_EQ(scene.Lights.size(), 1u);
  EXPECT_FALSE(renderer->IsActiveCameraCreated());
  EXPECT_EQ(renderer->GetLights()->GetNumberOfItems(), 0);
}

TEST(SceneExtraction, UsesVTKDefaultMaterial)
{
  const Scene scene = Extract(Cube());
  ASSERT_EQ(scene.Surfaces.size(), 1u);
  EXPECT_EQ(scene.Surfaces[0].Triangles.size(), 12u);
  EXPECT_EQ(scene.Surfaces[0].Front.DiffuseColor, glm::vec3(1.f));
  EXPECT_TRUE(scene.Lights[0].Headlight);
  EXPECT_TRUE(TracePixel(scene, 50.0, 50.0).IsHit());
  EXPECT_FALSE(TracePixel(scene, 2.0, 2.0).IsHit());
}

TEST(SceneExtraction, ResetsCameraAsVTK)
{
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(Cube());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetPosition(3.0, 2.0, 1.0);
  renderer->AddActor(actor);
  const Scene automatic = ExtractScene(renderer, Square());
  renderer->ResetCamera();
  const Scene vtk = ExtractScene(renderer, Square());
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_NEAR(automatic.Origin[k], vtk.Origin[k], 1e-12);
  }
  EXPECT_EQ(automatic.Scale, vtk.Scale);
  EXPECT_NEAR(automatic.ViewCamera.PixelSize, vtk.ViewCamera.PixelSize, 1e-15);
}

TEST(SceneExtraction, KeepsCellIdsOfPolygonsAndGrids)
{
  const Scene triangles = Extract(Polygons({ { 0, 1, 2 }, { 0, 2, 3 } }));
  EXPECT_TRUE(triangles.Surfaces[0].CellIds.empty());
  const Scene mixed = Extract(Polygons({ { 0, 1, 2, 3 }, { 0, 1, 2 } }));
  EXPECT_EQ(mixed.Surfaces[0].CellIds, (std::vector<std::uint32_t>{ 0, 0, 1 }));
  const Scene later = Extract(Polygons({ { 0, 1, 2 }, { 0, 1, 2, 3 } }));
  EXPECT_EQ(later.Surfaces[0].CellIds, (std::vector<std::uint32_t>{ 0, 1, 1 }));
  vtkNew<vtkImageData> grid;
  grid->SetDimensions(4, 4, 4);
  const Scene voxels = Extract(grid);
  ASSERT_EQ(voxels.Surfaces[0].CellIds.size(), 6u * 9u * 2u);
  for (const std::uint32_t cell : voxels.Surfaces[0].CellIds)
  {
    EXPECT_LT(cell, 27u);
    EXPECT_NE(cell, 13u); // the interior cell
  }
}

TEST(SceneExtraction, ReservesSpareCapacityForRayScene)
{
  const Scene scene = Extract(Cube());
  EXPECT_GT(scene.Surfaces[0].Positions.capacity(), scene.Surfaces[0].Positions.size());
  EXPECT_GT(scene.Surfaces[0].Triangles.capacity(), scene.Surfaces[0].Triangles.size());
}

TEST(SceneExtraction, DropsCellsWithInvalidPointsAndWarns)
{
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : { std::nan(""), infinity, -infinity })
  {
    vtkSmartPointer<vtkPolyData> data =
      Polygons({ { 0, 1, 2 }, { 0, 2, 3 }, { 0, 1, 3 }, { 0, 1, 77 }, { 0, 1, -5 } });
    data->GetPoints()->SetPoint(3, 0.0, bad, 0.0);
    const Scene scene = Extract(data);
    ASSERT_EQ(scene.Surfaces.size(), 1u);
    EXPECT_EQ(scene.Surfaces[0].Triangles.size(), 1u);
    EXPECT_TRUE(Warns(scene, "4 cells use points"));
    EXPECT_EQ(scene.Warnings.size(), 1u);
    EXPECT_TRUE(std::isfinite(scene.Scale));
    EXPECT_EQ(scene.Surfaces[0].CellIds, std::vector<std::uint32_t>{ 0 });
  }
}

TEST(SceneExtraction, IgnoresAttributesOfWrongSizeAndWarns)
{
  for (const vtkIdType size : { 1, 2, 4, 9 })
  {
    vtkSmartPointer<vtkPolyData> data = Polygons({ { 0, 1, 2 }, { 0, 2, 3 } });
    vtkNew<vtkFloatArray> triples;
    triples->SetNumberOfComponents(3);
    triples->SetNumberOfTuples(size);
    triples->Fill(1.0);
    data->GetPointData()->SetNormals(triples);
    data->GetPointData()->SetTCoords(triples);
    data->GetCellData()->SetNormals(triples);
    const Scene scene = Extract(data);
    EXPECT_EQ(scene.Surfaces[0].Normals.size(), size == 4 ? 4u : 0u);
    EXPECT_EQ(scene.Surfaces[0].TriangleNormals.size(), size == 2 ? 2u : 0u);
    EXPECT_EQ(Warns(scene, "normals of points"), size != 4);
    EXPECT_EQ(Warns(scene, "texture coordinates"), size != 4);
    EXPECT_EQ(Warns(scene, "normals of cells"), size != 2);
    EXPECT_EQ(data->GetPointData()->GetNormals(), triples); // the input is not modified
  }
}

// They are invisible, and sources such as spheres with coarse poles have some.
TEST(SceneExtraction, DropsDegenerateTriangles)
{
  const Scene scene = Extract(Polygons({ { 0, 0, 1 }, { 0, 1, 1 }, { 0, 1, 2 }, { 0 }, { 0, 1 } }));
  EXPECT_EQ(scene.Surfaces[0].Triangles.size(), 1u);
  EXPECT_TRUE(scene.Warnings.empty());
}

TEST(SceneExtraction, IsEmptyWithoutFinitePoints)
{
  vtkSmartPointer<vtkPolyData> data = Polygons({ { 0, 1, 2 } });
  for (vtkIdType i = 0; i < 4; ++i)
  {
    data->GetPoints()->SetPoint(i, std::nan(""), std::nan(""), std::nan(""));
  }
  const Scene scene = Extract(data);
  EXPECT_TRUE(scene.Surfaces.empty());
  EXPECT_EQ(scene.Warnings.size(), 1u);
}

TEST(SceneExtraction, WarnsAboutUnsupportedData)
{
  vtkNew<vtkTable> table;
  EXPECT_TRUE(Warns(Extract(table), "vtkTable"));
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkVolume> volume;
  renderer->AddVolume(volume);
  vtkNew<vtkVolume> hidden;
  hidden->VisibilityOff();
  renderer->AddVolume(hidden);
  const Scene scene = ExtractScene(renderer, Square());
  EXPECT_TRUE(Warns(scene, "Volume"));
  EXPECT_EQ(scene.Warnings.size(), 1u);
}

TEST(SceneExtraction, WarnsAboutUnsupportedProperties)
{
  vtkNew<vtkRenderer> renderer;
  vtkActor* actor = AddCube(renderer);
  EXPECT_TRUE(ExtractScene(renderer, Square()).Warnings.empty());
  actor->GetProperty()->SetTexture("second", vtkNew<vtkTexture>());
  vtkNew<vtkSelection> selection;
  actor->GetMapper()->SetSelection(selection);
  EXPECT_FALSE(Warns(ExtractScene(renderer, Square()), "selected cells"));
  selection->AddNode(vtkNew<vtkSelectionNode>());
  const Scene scene = ExtractScene(renderer, Square());
  EXPECT_TRUE(Warns(scene, "textures of the property"));
  EXPECT_TRUE(Warns(scene, "selected cells"));
  EXPECT_EQ(scene.Warnings.size(), 2u);
}

TEST(SceneExtraction, WarnsOncePerCause)
{
  vtkNew<vtkRenderer> renderer;
  for (int i = 0; i < 5; ++i)
  {
    AddCube(renderer)->GetProperty()->SetTexture("second", vtkNew<vtkTexture>());
  }
  const Scene scene = ExtractScene(renderer, Square());
  ASSERT_EQ(scene.Warnings.size(), 1u);
  EXPECT_EQ(scene.Warnings[0].rfind("Object 0, Object 1, Object 2 and 2 more: ", 0), 0u)
    << scene.Warnings[0];
}

TEST(SceneExtraction, KeepsTheAlphaOfTheBackground)
{
  vtkNew<vtkRenderer> renderer;
  EXPECT_EQ(ExtractScene(renderer, Square()).BackgroundColors.First.a, 1.f);
  renderer->SetBackgroundAlpha(0.25);
  EXPECT_EQ(ExtractScene(renderer, Square()).BackgroundColors.First.a, .25f);
  EXPECT_EQ(ExtractScene(renderer, Square()).BackgroundColors.Second.a, .25f);
}

TEST(SceneExtraction, ClipsAtTheClippingRange)
{
  vtkNew<vtkRenderer> renderer;
  AddCube(renderer);
  renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 5.0);
  renderer->GetActiveCamera()->SetClippingRange(5.0, 6.0);
  const Scene scene = ExtractScene(renderer, Square());
  ASSERT_EQ(scene.Surfaces.size(), 1u);
  for (const glm::uvec3& triangle : scene.Surfaces[0].Triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const glm::dvec3 x = scene.ToWorld(scene.Surfaces[0].Positions[triangle[k]]);
      EXPECT_LE(x.z, 1e-6);
    }
  }
  ExtractionOptions whole = Square();
  whole.ClipToRange = false;
  EXPECT_EQ(ExtractScene(renderer, whole).Surfaces[0].Triangles.size(), 12u);
  renderer->GetActiveCamera()->SetClippingRange(50.0, 60.0);
  EXPECT_TRUE(Warns(ExtractScene(renderer, Square()), "ResetCameraClippingRange"));
}

TEST(SceneExtraction, KeepsAllBehindANegligibleNearPlane)
{
  vtkNew<vtkRenderer> renderer;
  AddCube(renderer);
  renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 0.1); // in the cube
  renderer->GetActiveCamera()->SetClippingRange(1e-3, 1e9);
  const Scene scene = ExtractScene(renderer, Square());
  ASSERT_EQ(scene.Surfaces.size(), 1u);
  EXPECT_EQ(scene.Surfaces[0].Triangles.size(), 12u);
}

TEST(SceneExtraction, KeepsPrecisionForDistantAndSmallData)
{
  for (const auto& [center, size] :
    { std::pair<double, double>{ 1e7, 1e-3 }, { 0.0, 1e-6 }, { 0.0, 1e9 }, { 1e7, 100.0 } })
  {
    vtkSmartPointer<vtkPolyData> data = Polygons({ { 0, 1, 2, 3 } });
    for (vtkIdType i = 0; i < 4; ++i)
    {
      double x[3];
      data->GetPoints()->GetPoint(i, x);
      data->GetPoints()->SetPoint(i, center + size * x[0], center + size * x[1], center);
    }
    const Scene scene = Extract(data);
    // Expected corners: the square is inscribed in a sphere that subtends 30 degrees.
    const double half = 50.0 * std::sin(15.0 * 3.14159265358979 / 180.0) /
      std::tan(15.0 * 3.14159265358979 / 180.0) / std::sqrt(2.0);
    for (const glm::vec3& x : scene.Surfaces[0].Positions)
    {
      EXPECT_GT(glm::length(x), .1f);
      EXPECT_LT(glm::length(x), 10.f);
      const glm::dvec2 p = scene.ViewCamera.Project(x) - 50.0;
      EXPECT_NEAR(std::abs(p.x), half, 2e-4) << center << " " << size;
      EXPECT_NEAR(std::abs(p.y), half, 2e-4) << center << " " << size;
    }
  }
}

TEST(SceneExtraction, KeepsPrecisionForDistantParallelCamera)
{
  vtkNew<vtkRenderer> renderer;
  AddCube(renderer);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(6e6, 3e6, 1e7);
  camera->ParallelProjectionOn();
  camera->SetParallelScale(1.0);
  camera->SetClippingRange(1.0, 2e7);
  const Scene scene = ExtractScene(renderer, Square());
  EXPECT_NEAR(scene.ViewCamera.Advance / scene.Scale, std::sqrt(145e12), 4.0);
  const glm::dvec3 first = (glm::dvec3(-.5) - scene.Origin) * scene.Scale;
  EXPECT_NEAR(glm::length(glm::dvec3(scene.Surfaces[0].Positions[0]) - first), 0.0, 1e-7);
  EXPECT_TRUE(TracePixel(scene, 50.0, 50.0).IsHit());
  EXPECT_FALSE(TracePixel(scene, 1.0, 1.0).IsHit());
}

TEST(SceneExtraction, NumbersVisibleActorsAndDataSets)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, Cube());
  blocks->SetBlock(2, Cube());
  const Scene scene = ExtractScene(std::vector<vtkDataObject*>{ Cube(), blocks }, Square());
  ASSERT_EQ(scene.Surfaces.size(), 3u);
  EXPECT_EQ(scene.Surfaces[0].ObjectId, 0);
  EXPECT_EQ(scene.Surfaces[1].ObjectId, 1);
  EXPECT_EQ(scene.Surfaces[2].ObjectId, 1);
}

TEST(SceneExtraction, ScalesLineWidthsWithDPI)
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, 0.0);
  points->InsertNextPoint(1.0, 0.0, 0.0);
  vtkNew<vtkCellArray> lines;
  const vtkIdType line[2] = { 0, 1 };
  lines->InsertNextCell(2, line);
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  ExtractionOptions options = Square();
  options.DPI = 144;
  const Scene scene = ExtractScene(std::vector<vtkDataObject*>{ data }, options);
  ASSERT_EQ(scene.Surfaces.size(), 1u);
  EXPECT_TRUE(scene.Surfaces[0].IsLineOrPoint);
  const auto& x = scene.Surfaces[0].Positions;
  EXPECT_NEAR(
    glm::length(scene.ViewCamera.Project(x[3]) - scene.ViewCamera.Project(x[0])), 2.0, 1e-4);
}

TEST(SceneExtraction, CreatesHeadlightOnlyIfAutomatic)
{
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkLight> light;
  light->SetPosition(0.0, 0.0, 5.0);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  light->SetColor(.5, 1.0, .25);
  light->SetIntensity(.5);
  renderer->AddLight(light);
  Scene scene = ExtractScene(renderer, Square());
  ASSERT_EQ(scene.Lights.size(), 1u);
  EXPECT_EQ(scene.Lights[0].Direction, glm::vec3(0.f, 0.f, -1.f));
  EXPECT_EQ(scene.Lights[0].DiffuseColor, glm::vec3(.25f, .5f, .125f));
  EXPECT_TRUE(scene.Lights[0].CastsShadow);
  light->SwitchOff();
  scene = ExtractScene(renderer, Square());
  ASSERT_EQ(scene.Lights.size(), 1u);
  EXPECT_TRUE(scene.Lights[0].Headlight);
  EXPECT_FALSE(scene.Lights[0].CastsShadow);
  renderer->AutomaticLightCreationOff();
  EXPECT_TRUE(ExtractScene(renderer, Square()).Lights.empty());
}
