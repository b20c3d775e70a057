// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Surfaces whose triangles are smaller than pixels, and changes of color inside pixels without edges: exact outlines,
// and tiles within the tolerance. References are closed forms of coverage, and jittered samples.
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"

#include "BruteForce/StratifiedReference.h"
#include "Scenes/AccuracyScenes.h"
#include "Scenes/Adversaries.h"
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace penumbra;

namespace
{

constexpr int Size = 64;

/// Builds the upper half of a ball above a disc with the same number of edges.
vtkSmartPointer<vtkPolyData> MakeDome(const Shape& disc, double height, int rings)
{
  const auto around = static_cast<vtkIdType>(disc.Outline.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  const vtkIdType top = points->InsertNextPoint(disc.Center.x, disc.Center.y, height);
  for (int ring = 1; ring <= rings; ++ring)
  {
    const double angle = 0.5 * std::acos(-1.0) * ring / rings;
    for (const glm::dvec2& corner : disc.Outline)
    {
      const glm::dvec2 p =
        ring == rings ? corner : disc.Center + std::sin(angle) * (corner - disc.Center);
      points->InsertNextPoint(p.x, p.y, ring == rings ? 0.0 : height * std::cos(angle));
    }
  }
  for (vtkIdType i = 0; i < around; ++i)
  {
    const vtkIdType j = (i + 1) % around;
    const vtkIdType cap[3] = { top, 1 + i, 1 + j };
    cells->InsertNextCell(3, cap);
    for (int ring = 0; ring + 1 < rings; ++ring)
    {
      const vtkIdType low = 1 + ring * around;
      const vtkIdType triangles[2][3] = { { low + i, low + around + i, low + around + j },
        { low + i, low + around + j, low + j } };
      cells->InsertNextCell(3, triangles[0]);
      cells->InsertNextCell(3, triangles[1]);
    }
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  return mesh;
}

vtkSmartPointer<vtkRenderer> MakeScene(const Shape& disc, int rings)
{
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, MakeDome(disc, 10.0, rings), false);
  LookAtImage(renderer, Size, Size);
  return renderer;
}

vtkSmartPointer<vtkPolyData> MakePlane(int resolution, double z)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(0.0, 0.0, z);
  plane->SetPoint1(Size, 0.0, z);
  plane->SetPoint2(0.0, Size, z);
  plane->SetResolution(resolution, resolution);
  plane->Update();
  return plane->GetOutput();
}

/// Colors the cells of a mesh with gray values in [0, 255].
template <typename Gray>
void ColorCells(vtkPolyData* mesh, const Gray& gray)
{
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    const auto value = static_cast<double>(gray(i));
    colors->InsertNextTuple3(value, value, value);
  }
  mesh->GetCellData()->SetScalars(colors);
}

/// Expects that no tile has an error above the tolerance and a smaller estimate.
void ExpectAccurateTiles(vtkRenderer* renderer, int side)
{
  const StratifiedReference reference = DrawStratified(renderer, Size, Size, side, false);
  for (const TileAccuracy& tile : CompareTiles(Cast(renderer, Size, Size), reference, Size))
  {
    EXPECT_LE(tile.Error, std::max(1.0 / 256.0, tile.Estimate));
  }
}

}

// A pixel with one visible edge has a closed form. Counting the hidden ones, it would be sampled.
TEST(HiddenEdges, KeepVisibleOnesExact)
{
  constexpr double Edge = 20.3706; // x at which the cells in front meet
  vtkSmartPointer<vtkPolyData> front = MakePlane(1, 1.0);
  vtkNew<vtkPoints> points;
  for (const double x : { 0.0, Edge, static_cast<double>(Size) })
  {
    points->InsertNextPoint(x, 0.0, 1.0);
    points->InsertNextPoint(x, Size, 1.0);
  }
  vtkNew<vtkCellArray> cells;
  for (vtkIdType i = 0; i < 4; i += 2)
  {
    const vtkIdType corners[4] = { i, i + 2, i + 3, i + 1 };
    cells->InsertNextCell(4, corners);
  }
  front->Initialize();
  front->SetPoints(points);
  front->SetPolys(cells);
  ColorCells(front, [](vtkIdType i) { return i == 0 ? 255 : 51; });
  constexpr int Resolution = 50; // of the cells behind, whose colors alternate
  const vtkSmartPointer<vtkPolyData> back = MakePlane(Resolution, 0.0);
  ColorCells(back, [](vtkIdType i) { return (i + i / Resolution) % 2 * 255; });
  const vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, front, false)->GetMapper()->ScalarVisibilityOn();
  AddMesh(renderer, back, false)->GetMapper()->ScalarVisibilityOn();
  LookAtImage(renderer, Size, Size);
  const Answer answer = Cast(renderer, Size, Size);
  for (int i = 0; i < Size * Size; ++i)
  {
    const double covered = std::clamp(Edge - i % Size, 0.0, 1.0);
    EXPECT_NEAR(answer.Colors[i].x, 0.2 + 0.8 * covered, 1e-5) << i;
  }
}

// Exact coverage of these crossing lines takes 6.0 rays per pixel.
TEST(OpaqueLines, NeedFewRaysWithinTheTolerance)
{
  const vtkSmartPointer<vtkRenderer> renderer =
    NewAdversaryRenderer(FindAdversary("Hair")->Make(200), 1.0);
  EXPECT_LE(Cast(renderer, Size, Size).RaysPerPixel, 2.0);
  ExpectAccurateTiles(renderer, 16);
}

TEST(DenseSurfaces, HaveExactOutlines)
{
  const Shape disc = Disc({ 31.7, 32.4 }, 25.0, 200);
  const std::vector<double> shares = SharesOf({ disc }, Size, Size);
  const Answer answer = Cast(MakeScene(disc, 60), Size, Size);
  for (std::size_t i = 0; i < shares.size(); ++i)
  {
    EXPECT_NEAR(answer.Colors[i].g, shares[i], 1e-4) << "pixel " << i % Size << ", " << i / Size;
  }
  EXPECT_LE(answer.RaysPerPixel, 2.0);
}

TEST(DenseSurfaces, HaveEdgesThatSubdivisionFinds)
{
  const Shape disc = Disc({ 31.5, 32.5 }, 0.4, 100);
  const Answer answer = Cast(MakeScene(disc, 60), Size, Size, [](vtkPenumbraRayCaster* caster) {
    caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Subdivision;
    caster->GetConstants().MaximumLevel = 3;
  });
  EXPECT_NEAR(answer.Colors[32 * Size + 31].g, std::acos(-1.0) * 0.16, 0.1);
}

TEST(DenseSurfaces, AreWithinTheToleranceAtACostThatFollowsIt)
{
  for (const bool smooth : { false, true })
  {
    vtkNew<vtkRenderer> renderer;
    BuildGyroid(renderer, 10.0, smooth, AccuracyImageSide);
    const StratifiedReference reference =
      DrawStratified(renderer, AccuracyImageSide, AccuracyImageSide, 8, false);
    double rays[2];
    for (const int step : { 0, 1 })
    {
      const double tolerance = step == 0 ? 1.0 / 64.0 : 1.0 / 256.0;
      const Answer answer = Cast(renderer, AccuracyImageSide, AccuracyImageSide,
        [&](vtkPenumbraRayCaster* caster) { caster->SetTolerance(tolerance); });
      rays[step] = answer.RaysPerPixel;
      const std::vector<TileAccuracy> tiles = CompareTiles(answer, reference, AccuracyImageSide);
      std::size_t above = 0;
      for (const TileAccuracy& tile : tiles)
      {
        above += tile.Error > tolerance ? 1 : 0;
      }
      EXPECT_LE(20 * above, tiles.size()) << tolerance << smooth;
    }
    EXPECT_LE(rays[0], 4.0) << smooth;
    EXPECT_LE(3.0 * rays[0], rays[1]) << smooth;
    EXPECT_LE(rays[1], 30.0) << smooth;
  }
}

TEST(ColorsInsidePixels, AreFoundInTexturesBehindTranslucentSurfaces)
{
  std::mt19937 random(1);
  vtkNew<vtkImageData> image;
  image->SetDimensions(80, 80, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  for (int i = 0; i < 6400; ++i)
  {
    image->SetScalarComponentFromDouble(i % 80, i / 80, 0, 0, random() % 8 == 0 ? 255.0 : 0.0);
  }
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, MakePlane(1, 0.0), false)->SetTexture(texture);
  AddMesh(renderer, MakePlane(1, 1.0), false)->GetProperty()->SetOpacity(0.3);
  LookAtImage(renderer, Size, Size);
  ExpectAccurateTiles(renderer, 16);
}

TEST(ColorsInsidePixels, AreFoundInTexturesOfStripsBehindATranslucentSurface)
{
  // Strips as wide as a pixel, black on one side and white on the other: most are seen by one corner only.
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 1, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  image->SetScalarComponentFromDouble(0, 0, 0, 0, 0.0);
  image->SetScalarComponentFromDouble(1, 0, 0, 0, 255.0);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  for (int i = 0; i < Size / 2; ++i)
  {
    const double x = 2.0 * i + 0.37;
    vtkNew<vtkPlaneSource> strip;
    strip->SetOrigin(x, 0.0, 0.0);
    strip->SetPoint1(x + 1.0, 0.0, 0.0);
    strip->SetPoint2(x + 3.0, Size, 0.0);
    strip->Update();
    AddMesh(renderer, strip->GetOutput(), false)->SetTexture(texture);
  }
  AddMesh(renderer, MakePlane(1, 1.0), false)->GetProperty()->SetOpacity(0.3);
  LookAtImage(renderer, Size, Size);
  ExpectAccurateTiles(renderer, 16);
}

TEST(ColorsInsidePixels, AreFoundAtAConeSmallerThanAPixel)
{
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, MakePlane(1, 0.0), false)->GetProperty()->LightingOn();
  LookAtImage(renderer, Size, Size);
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->PositionalOn();
  light->SetPosition(30.6, 30.4, 10.0);
  light->SetFocalPoint(30.6, 30.4, 0.0);
  light->SetConeAngle(2.4); // a radius of 0.42 pixels
  light->SetIntensity(20.0);
  renderer->RemoveAllLights();
  renderer->AddLight(light);
  ExpectAccurateTiles(renderer, 32);
}

TEST(ColorsInsidePixels, AreFoundAtTheConesOfSpotlights)
{
  for (const double trianglesPerPixel : { 0.05, 3.0 }) // exact areas of faces, rasterized samples
  {
    vtkNew<vtkRenderer> renderer;
    BuildGyroid(renderer, trianglesPerPixel, false, Size);
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->PositionalOn();
    light->SetPosition(0.0, 0.0, 1.0);
    light->SetFocalPoint(0.0, 0.0, 0.0);
    light->SetConeAngle(8.0);
    light->SetIntensity(3.0);
    renderer->AddLight(light);
    ExpectAccurateTiles(renderer, 16);
  }
}

TEST(DenseSurfaces, AreInFrontOfWhatTheyHideNextToTrianglesSeenEdgeOn)
{
  vtkNew<vtkRenderer> renderer;
  BuildGyroid(renderer, 0.3, false, Size);
  ExpectAccurateTiles(renderer, 16);
}

TEST(ColorsInsidePixels, AreAveragedOnSpheresOfAPixel)
{
  std::mt19937 random(1);
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (vtkIdType i = 0; i < 500; ++i)
  {
    const double x = 0.01 * (random() % 6400);
    points->InsertNextPoint(x, 0.01 * (random() % 6400), 0.01 * (random() % 1000));
    cells->InsertNextCell(1, &i);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(cells);
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  vtkProperty* property = AddMesh(renderer, data, true)->GetProperty();
  property->RenderPointsAsSpheresOn();
  property->SetPointSize(1.02f);
  LookAtImage(renderer, Size, Size);
  ExpectAccurateTiles(renderer, 24);
}

TEST(ColorsInsidePixels, AreFoundWhereSpheresEmergeFromFacets)
{
  vtkNew<vtkRenderer> renderer;
  BuildGyroid(renderer, 0.3, false, Size);
  vtkActor* actor = vtkActor::SafeDownCast(renderer->GetViewProps()->GetItemAsObject(0));
  actor->GetProperty()->VertexVisibilityOn();
  actor->GetProperty()->SetVertexColor(1.0, 0.0, 0.0);
  actor->GetProperty()->RenderPointsAsSpheresOn();
  actor->GetProperty()->SetPointSize(5.f);
  ExpectAccurateTiles(renderer, 16);
}
