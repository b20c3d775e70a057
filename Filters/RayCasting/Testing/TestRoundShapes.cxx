// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Points as spheres and lines as tubes: shading against the normal of the sphere, occlusion and
// shadows against closed forms.
#include "RoundScene.h"

#include "vtkLight.h"
#include "vtkPenumbraRayCasterConstants.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

using namespace penumbra_testing;

namespace
{

/// Returns a square of side 40 in the plane z = 0.
vtkSmartPointer<vtkPolyData> MakeFloor()
{
  vtkNew<vtkPoints> corners;
  vtkNew<vtkCellArray> cells;
  for (const double sign : { -1.0, 1.0 })
  {
    corners->InsertNextPoint(20.0 * sign, -20.0, 0.0);
    corners->InsertNextPoint(20.0 * sign, 20.0, 0.0);
  }
  const vtkIdType quad[4] = { 0, 2, 3, 1 };
  cells->InsertNextCell(4, quad);
  auto plane = vtkSmartPointer<vtkPolyData>::New();
  plane->SetPoints(corners);
  plane->SetPolys(cells);
  return plane;
}

/// Returns the centers of random spheres in a box between the depths `near` and `near` + 4.
std::vector<glm::dvec3> MakeRandomCenters(int count, double near)
{
  std::mt19937 random(1);
  const auto next = [&] { return random() / 4294967296.0; };
  std::vector<glm::dvec3> centers;
  for (int i = 0; i < count; ++i)
  {
    const double x = 2.0 * next() - 1.0;
    const double y = 2.0 * next() - 1.0;
    centers.emplace_back(x, y, -near - 4.0 * next());
  }
  return centers;
}

/// Returns the RMSE of each tile of 16x16 pixels of an image of 64x64.
std::vector<double> CompareTiles(const std::vector<double>& a, const std::vector<double>& b)
{
  std::vector<double> errors(16, 0.0);
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    errors[i / 1024 * 4 + i % 64 / 16] += (a[i] - b[i]) * (a[i] - b[i]) / 256.0;
  }
  for (double& error : errors)
  {
    error = std::sqrt(error);
  }
  return errors;
}

}

TEST(RoundShapes, LightsSpheresByTheirNormals)
{
  // One sphere in parallel projection under a headlight: color = cosine of normal and view axis.
  RoundScene scene(MakeCells({ { 0.0, 0.0, -5.0 } }, {}), true);
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(1.0);
  vtkNew<vtkLight> headlight;
  headlight->SetLightTypeToHeadlight();
  scene.Renderer->AddLight(headlight);
  scene.Caster->SetPointRadius(0.8);
  const std::vector<double> image = scene.RenderRed();
  for (const double at : { 0.0, 0.3, 0.6 })
  {
    const int x = static_cast<int>((1.0 + at) * 0.5 * Side);
    const double center = (x + 0.5) / (0.5 * Side) - 1.0;
    const double y = 0.5 / (0.5 * Side);
    const double expected = std::sqrt(1.0 - (center * center + y * y) / 0.64);
    EXPECT_NEAR(image[Side / 2 * Side + x], expected, 1e-3) << at;
  }
}

TEST(RoundShapes, InterpolatesColorsAlongTubes)
{
  vtkSmartPointer<vtkPolyData> line =
    MakeCells({ { -1.0, 0.0, -5.0 }, { 1.0, 0.0, -5.0 } }, { { 0, 1 } });
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  colors->InsertNextTuple3(0, 0, 0);
  colors->InsertNextTuple3(255, 0, 0);
  line->GetPointData()->SetScalars(colors);
  RoundScene scene(line);
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(2.0);
  scene.Caster->SetLineRadius(0.2);
  const std::vector<double> image = scene.RenderRed();
  for (const double at : { -0.9, -0.5, 0.0, 0.4, 0.9 })
  {
    const int x = static_cast<int>((2.0 + at) * 0.25 * Side);
    const double center = (x + 0.5) / (0.25 * Side) - 2.0;
    EXPECT_NEAR(image[Side / 2 * Side + x], 0.5 * (center + 1.0), 3e-3) << at;
  }
}

TEST(RoundShapes, UsesTheSizesOfTheProperty)
{
  // A sphere and a tube of 40 pixels at the view axis: the covered height of column 128.
  RoundScene spheres(MakeCells({ { 0.0, 0.0, -9.0 } }, {}));
  spheres.Actor->GetProperty()->RenderPointsAsSpheresOn();
  spheres.Actor->GetProperty()->SetPointSize(40.f);
  RoundScene tubes(MakeCells({ { -9.0, 0.0, -9.0 }, { 9.0, 0.0, -9.0 } }, { { 0, 1 } }));
  tubes.Actor->GetProperty()->RenderLinesAsTubesOn();
  tubes.Actor->GetProperty()->SetLineWidth(40.f);
  for (RoundScene* scene : { &spheres, &tubes })
  {
    const std::vector<double> image = scene->RenderRed();
    double height = 0.0;
    for (int y = 0; y < Side; ++y)
    {
      height += image[y * Side + Side / 2];
    }
    EXPECT_NEAR(height, 40.0, 0.2); // the outline in perspective is slightly larger
  }
}

TEST(RoundShapes, StartWhereTheBoundsOfTheirPointsDoNotReach)
{
  // The bounds of a point are empty, so that rays that start at the bounds start within the sphere.
  for (const bool parallel : { false, true })
  {
    for (const bool inPixels : { false, true })
    {
      RoundScene scene(MakeCells({ { 0.0, 0.0, -50.0 } }, {}));
      vtkCamera* camera = scene.Renderer->GetActiveCamera();
      camera->SetParallelProjection(parallel);
      camera->SetParallelScale(20.0);
      scene.Caster->SetPointRadius(inPixels ? 0.0 : 4.0);
      scene.Actor->GetProperty()->SetRenderPointsAsSpheres(inPixels);
      scene.Actor->GetProperty()->SetPointSize(40.f);
      const double height = parallel ? 40.0 : 100.0 * std::tan(glm::radians(ViewAngle) / 2.0);
      const double radius = inPixels ? 20.0 * height / Side : 4.0;
      scene.Caster->SetGeometryArrays(true);
      scene.Caster->Update();
      const double depth =
        scene.Caster->GetOutput()->GetPointData()->GetArray("Depth")->GetComponent(
          Side / 2 * Side + Side / 2, 0);
      EXPECT_NEAR(depth, 50.0 - radius, 0.02 * radius) << parallel << ' ' << inPixels;
    }
  }
}

TEST(RoundShapes, OccludeThePlaneBelow)
{
  // A sphere that is completely above the horizon blocks (r / d)^2 times the cosine to its center,
  // here r / d. At the distance s from the contact with the plane, d^2 = s^2 + r^2.
  RoundScene scene(MakeCells({ { 0.0, 0.0, 1.0 } }, {}));
  scene.Add(MakeFloor(), false);
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->SetPosition(0.0, 0.0, 20.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->ParallelProjectionOn();
  camera->SetParallelScale(4.0);
  scene.Caster->SetPointRadius(1.0);
  scene.Caster->SetResolution(64, 64);
  scene.Caster->SetTolerance(0.01);
  scene.Caster->AmbientOcclusionOn();
  scene.Caster->SetAmbientOcclusionRadius(1e6);
  const std::vector<double> image = scene.RenderRed();
  for (const double s : { 1.4, 2.0, 3.0 })
  {
    const int x = static_cast<int>((4.0 + s) * 8.0);
    const double at = (x + 0.5) / 8.0 - 4.0;
    const double expected = std::pow(1.0 / std::sqrt(at * at + 1.0), 3.0);
    EXPECT_NEAR(1.0 - image[32 * 64 + x], expected, 0.02) << s;
  }
}

TEST(RoundShapes, CastShadows)
{
  // A light along the view axis of a parallel camera from above, and a tube: its shadow is as wide
  // as the tube, displaced by the slanted light.
  RoundScene scene(MakeCells({ { 0.0, -9.0, 1.0 }, { 0.0, 9.0, 1.0 } }, { { 0, 1 } }), true);
  scene.Add(MakeFloor(), true);
  scene.Renderer->AutomaticLightCreationOff();
  vtkNew<vtkLight> sun;
  sun->SetLightTypeToSceneLight();
  sun->SetPosition(1.0, 0.0, 1.0);
  sun->SetFocalPoint(0.0, 0.0, 0.0);
  scene.Renderer->AddLight(sun);
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->SetPosition(0.0, 0.0, 20.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->ParallelProjectionOn();
  camera->SetParallelScale(4.0);
  scene.Caster->SetLineRadius(0.25);
  scene.Caster->ShadowsOn();
  const std::vector<double> image = scene.RenderRed();
  // The shadow of the axis is at x = -1; its half width on the plane is 0.25 * sqrt(2).
  double dark = 0.0;
  for (int x = 0; x < Side / 2 - 10; ++x)
  {
    const double lit = std::sqrt(0.5);
    dark += (1.0 - image[Side / 2 * Side + x] / lit) * 8.0 / Side;
  }
  EXPECT_NEAR(dark, 0.5 * std::sqrt(2.0), 0.01);
}

TEST(RoundShapes, BlendOneLayerOfATranslucentShape)
{
  // A polyline of three joined tubes: everywhere one layer of opacity 0.5, also at the joints.
  RoundScene scene(
    MakeCells({ { -1.0, 0.0, -5.0 }, { -0.3, 0.0, -5.0 }, { 0.3, 0.2, -5.0 }, { 1.0, 0.2, -5.0 } },
      { { 0, 1, 2, 3 } }));
  scene.Actor->GetProperty()->SetOpacity(0.5);
  scene.Caster->SetLineRadius(0.2);
  for (const double red : scene.RenderRed())
  {
    ASSERT_LE(red, 0.501);
  }
  EXPECT_NEAR(scene.RenderRed()[Side / 2 * Side + Side / 2], 0.5, 1e-3);
}

TEST(RoundShapes, RejectsARadiusThatIsNotANumber)
{
  RoundScene scene(MakeCells(FiveCenters, {}));
  scene.Caster->SetPointRadius(std::nan(""));
  scene.Caster->SetGlobalWarningDisplay(0);
  scene.Caster->Update();
  EXPECT_EQ(scene.Caster->GetOutput()->GetNumberOfPoints(), 0);
  scene.Caster->SetGlobalWarningDisplay(1);
}

/// Requests a part of an image of `width` pixels in a row, and compares it with the whole one.
void ExpectSameBitsInPart(
  RoundScene& scene, const std::vector<double>& whole, int width, const std::array<int, 6>& part)
{
  scene.Caster->UpdateExtent(part.data());
  vtkImageData* image = scene.Caster->GetOutput();
  vtkDataArray* colors = image->GetPointData()->GetArray("Color");
  for (int y = part[2]; y <= part[3]; ++y)
  {
    for (int x = part[0]; x <= part[1]; ++x)
    {
      int at[3] = { x, y, 0 };
      const vtkIdType id = image->ComputePointId(at);
      ASSERT_EQ(colors->GetComponent(id, 0) * colors->GetComponent(id, 3), whole[y * width + x]);
    }
  }
}

TEST(RoundShapes, GivesTheSameBitsForAnyTiling)
{
  RoundScene scene(MakeCells(FiveCenters, {}), true);
  scene.Caster->SetPointRadius(1.0); // the spheres intersect
  const std::vector<double> whole = scene.RenderRed();
  scene.Caster->SetNumberOfThreads(1);
  ExpectSameBitsInPart(scene, whole, Side, { 100, 180, 70, 150, 0, 0 });
}

TEST(RoundShapes, AreSampledWhereTubesIntersectASurface)
{
  // Tubes, about one pixel wide, that emerge gradually from a plane of another color.
  std::vector<glm::dvec3> points;
  std::vector<std::vector<vtkIdType>> lines;
  for (int i = 0; i < 24; ++i)
  {
    const double y = -1.5 + 0.13 * i;
    const auto first = static_cast<vtkIdType>(points.size());
    points.emplace_back(-1.8, y, -6.015);
    points.emplace_back(1.8, y + 0.3, -5.995);
    lines.push_back({ first, first + 1 });
  }
  RoundScene scene(MakeCells(points, lines));
  vtkActor* plane = scene.Add(MakeFloor(), false);
  plane->SetPosition(0.0, 0.0, -6.0);
  plane->GetProperty()->SetColor(0.1, 0.1, 0.1);
  scene.Caster->SetLineRadius(0.015);
  scene.Renderer->GetActiveCamera()->Zoom(2.0);
  constexpr int Size = 64;
  constexpr int Tile = 16;
  scene.Caster->SetResolution(Size, Size);
  const std::vector<double> image = scene.RenderRed();
  std::vector<double> estimates;
  vtkDataArray* errors = scene.Caster->GetOutput()->GetPointData()->GetArray("EstimatedError");
  for (vtkIdType i = 0; i < errors->GetNumberOfTuples(); ++i)
  {
    estimates.push_back(errors->GetTuple1(i));
  }
  scene.Caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Uniform;
  scene.Caster->GetConstants().UniformSamples = 16;
  const std::vector<double> reference = scene.RenderRed();
  for (int tile = 0; tile < Size / Tile * (Size / Tile); ++tile)
  {
    double squares = 0.0;
    double estimated = 0.0;
    for (int i = 0; i < Tile * Tile; ++i)
    {
      const int x = tile % (Size / Tile) * Tile + i % Tile;
      const int y = tile / (Size / Tile) * Tile + i / Tile;
      const double difference = image[y * Size + x] - reference[y * Size + x];
      squares += difference * difference / (Tile * Tile);
      estimated += estimates[y * Size + x] * estimates[y * Size + x] / (Tile * Tile);
    }
    EXPECT_LE(std::sqrt(squares), std::max(1.5 / 256.0, std::sqrt(estimated))) << tile;
  }
}

TEST(RoundShapes, AreWithinTheToleranceIfOutlinesAreTooManyToCut)
{
  RoundScene scene(MakeCells(MakeRandomCenters(60000, 5.0), {}), true);
  scene.Caster->SetResolution(64, 64);
  scene.Caster->SetPointRadius(0.03);
  scene.Caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Uniform;
  scene.Caster->GetConstants().UniformSamples = 24;
  const std::vector<double> reference = scene.RenderRed();
  scene.Caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Silhouettes;
  for (const double tolerance : { 0.05, 0.01 })
  {
    scene.Caster->SetTolerance(tolerance);
    for (const double error : CompareTiles(scene.RenderRed(), reference))
    {
      EXPECT_LT(error, tolerance);
    }
    EXPECT_GT(scene.Statistic("Pixels/Uniform"), 2000.0);
    EXPECT_EQ(scene.Statistic("Tiles/AboveTolerance"), 0.0);
  }
}

TEST(RoundShapes, GiveTheSameBitsForPartsOfTilesWithManyOutlines)
{
  for (const int count : { 3000, 60000 })
  {
    RoundScene scene(MakeCells(MakeRandomCenters(count, 5.0), {}), true);
    scene.Caster->SetResolution(64, 64);
    scene.Caster->SetPointRadius(0.03);
    const std::vector<double> whole = scene.RenderRed();
    ExpectSameBitsInPart(scene, whole, 64, { 11, 37, 20, 44, 0, 0 });
  }
}

TEST(RoundShapes, AreOccludedWithinTheToleranceIfTheyAreSmall)
{
  RoundScene scene(MakeCells(MakeRandomCenters(60000, 5.0), {}));
  scene.Caster->SetResolution(64, 64);
  scene.Caster->SetPointRadius(0.03);
  scene.Caster->AmbientOcclusionOn();
  scene.Caster->SetAmbientOcclusionRadius(0.15);
  scene.Caster->SetTolerance(0.03);
  scene.Caster->SetLightTolerance(0.03);
  scene.Caster->GeometryArraysOn();
  const std::vector<double> image = scene.RenderRed();
  EXPECT_EQ(scene.Statistic("Tiles/AboveTolerance"), 0.0);
  vtkDataArray* occlusion = scene.Caster->GetOutput()->GetPointData()->GetArray("AmbientOcclusion");
  int covered = 0; // pixels of white unlit spheres before black
  for (vtkIdType i = 0; i < occlusion->GetNumberOfTuples(); ++i)
  {
    EXPECT_LE(image[i], 1.0 - occlusion->GetTuple1(i) + 1e-5) << i;
    covered += image[i] > 1.0 - occlusion->GetTuple1(i) - 1e-5 ? 1 : 0;
  }
  EXPECT_GT(covered, 800);
  scene.Caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Uniform;
  scene.Caster->GetConstants().UniformSamples = 12;
  for (const double error : CompareTiles(scene.RenderRed(), image))
  {
    EXPECT_GT(error, 0.0);
    EXPECT_LT(error, std::hypot(0.03, 0.03));
  }
}

TEST(RoundShapes, AreOccludedWithinTheLightToleranceIfItIsTheSmallerOne)
{
  RoundScene scene(MakeCells(MakeRandomCenters(60000, 5.0), {}));
  scene.Caster->SetResolution(32, 32);
  scene.Caster->SetPointRadius(0.03);
  scene.Caster->AmbientOcclusionOn();
  scene.Caster->SetAmbientOcclusionRadius(0.15);
  scene.Caster->SetTolerance(0.2);
  scene.Caster->SetLightTolerance(0.02);
  const std::vector<double> image = scene.RenderRed();
  scene.Caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Uniform;
  scene.Caster->GetConstants().UniformSamples = 12;
  for (const double error : CompareTiles(scene.RenderRed(), image))
  {
    EXPECT_LT(error, std::hypot(0.02, 0.02));
  }
}

TEST(RoundShapes, HaveTheSameOcclusionForPartsAndAnyNumberOfThreads)
{
  for (const int count : { 3000, 60000 })
  {
    RoundScene scene(MakeCells(MakeRandomCenters(count, 5.0), {}), true);
    scene.Caster->SetResolution(64, 64);
    scene.Caster->SetPointRadius(0.03);
    scene.Caster->AmbientOcclusionOn();
    scene.Caster->SetTolerance(0.05);
    scene.Caster->SetNumberOfThreads(1);
    const std::vector<double> whole = scene.RenderRed();
    scene.Caster->SetNumberOfThreads(3);
    EXPECT_EQ(scene.RenderRed(), whole) << count;
    ExpectSameBitsInPart(scene, whole, 64, { 11, 37, 20, 44, 0, 0 });
  }
}

TEST(RoundShapes, TakeNoSamplesIfManyAreHidden)
{
  RoundScene scene(MakeCells(FiveCenters, {}), true);
  scene.Add(MakeFloor(), true)->SetPosition(0.0, 0.0, -8.0);
  scene.Caster->SetResolution(64, 64);
  scene.Caster->SetPointRadius(0.3);
  const std::vector<double> alone = scene.RenderRed();
  const double rays = scene.Statistic("Rays/Total");
  scene.Add(MakeCells(MakeRandomCenters(20000, 9.0), {}), true);
  EXPECT_EQ(scene.RenderRed(), alone);
  EXPECT_EQ(scene.Statistic("Rays/Total"), rays);
}
