// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Colors that vary in a pixel although its corners agree, found by random scenes.
#include "BruteForce/StratifiedReference.h"
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace penumbra;

namespace
{

constexpr int Side = 96;
constexpr double Tolerance = 1.0 / 256.0;

/// Largest difference of a pixel from stratified samples.
double FindWorst(vtkRenderer* renderer)
{
  const Answer answer = Cast(
    renderer, Side, Side, [](vtkPenumbraRayCaster* caster) { caster->SetTolerance(Tolerance); });
  const StratifiedReference reference = DrawStratified(renderer, Side, Side, 16, false);
  double worst = 0.0;
  for (std::size_t i = 0; i < answer.Colors.size(); ++i)
  {
    const glm::dvec3 difference = glm::abs(answer.Colors[i] - reference.Colors[i]);
    worst = std::max({ worst, difference.x, difference.y, difference.z });
  }
  return worst;
}

/// Adds spheres with a diameter in pixels.
void AddSpheres(vtkRenderer* renderer, const std::vector<glm::dvec3>& centers, float diameter)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  for (const glm::dvec3& center : centers)
  {
    const vtkIdType id = points->InsertNextPoint(center.x, center.y, center.z);
    vertices->InsertNextCell(1, &id);
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetVerts(vertices);
  vtkProperty* property = AddMesh(renderer, mesh, true)->GetProperty();
  property->SetPointSize(diameter);
  property->RenderPointsAsSpheresOn();
}

/// Adds an unlit quadrilateral.
vtkProperty* AddQuadrilateral(vtkRenderer* renderer, const std::vector<glm::dvec3>& corners)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> polygons;
  polygons->InsertNextCell(4);
  for (const glm::dvec3& corner : corners)
  {
    polygons->InsertCellPoint(points->InsertNextPoint(corner.x, corner.y, corner.z));
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(polygons);
  return AddMesh(renderer, mesh, false)->GetProperty();
}

}

TEST(SmallSpheres, AreShadedBetweenTheCornersOfPixels)
{
  for (const float diameter : { 1.64f, 3.f, 5.f })
  {
    vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
    std::vector<glm::dvec3> centers;
    for (int i = 0; i < 144; ++i)
    {
      // Some in the middle of a pixel.
      centers.emplace_back(
        4.5 + 8.0 * (i % 12) + .04 * (i % 5), 4.5 + 8.0 * (i / 12) + .04 * (i % 7), 0.0);
    }
    AddSpheres(renderer, centers, diameter);
    LookAtImage(renderer, Side, Side);
    EXPECT_LT(FindWorst(renderer), 0.03) << diameter;
  }
}

TEST(SmallSpheres, AreShadedBetweenTheirOutlines)
{
  std::mt19937 generator(1);
  const auto random = [&](double high) { return high * generator() * 0x1p-32; };
  for (int round = 0; round < 2; ++round)
  {
    vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
    std::vector<glm::dvec3> centers;
    for (int i = 0; i < 576; ++i)
    {
      centers.emplace_back(
        8.0 * (i / 4 % 12) + 3.0 + random(2.0), 8.0 * (i / 48) + 3.0 + random(2.0), random(20.0));
    }
    AddSpheres(renderer, centers, 1.64f);
    LookAtImage(renderer, Side, Side);
    EXPECT_LT(FindWorst(renderer), 0.05) << round;
  }
}

TEST(TranslucentSurfaces, ShowIntersectionsBehindThem)
{
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  renderer->SetBackground(0.2, 0.4, 0.8);
  // Strips in front of a translucent and an opaque surface, which intersect along x = 48 + y / 20.
  for (int i = 0; i < 48; ++i)
  {
    const double x = 2.0 * i;
    AddQuadrilateral(
      renderer, { { x, 0, 30 }, { x + 2, 0, 30 }, { x + 7, Side, 30 }, { x + 5, Side, 30 } })
      ->SetOpacity(.3 + .01 * i);
  }
  AddQuadrilateral(
    renderer, { { 20, 0, -14 }, { 80, 0, 16 }, { 80, Side, 13.6 }, { 20, Side, -16.4 } })
    ->SetOpacity(.6);
  AddQuadrilateral(renderer, { { -9, -9, 0 }, { 105, -9, 0 }, { 105, 105, 0 }, { -9, 105, 0 } })
    ->SetColor(0.0, 0.0, 0.0);
  LookAtImage(renderer, Side, Side);
  EXPECT_LT(FindWorst(renderer), 0.04);
}

TEST(Ribbons, TakeNoRayInTheMiddleOfPixelsOfConstantColor)
{
  // In one pixel of eight, all corners are on one triangle that no further corner along the x-axis shows.
  const auto countRays = [](double width) {
    vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
    for (double x = 2.8; x < Side; x += 8.0)
    {
      AddQuadrilateral(renderer,
        { { x, -10.0, 0.0 }, { x + width, -10.0, 0.0 }, { x + width, 1800.0, 0.0 },
          { x, 1800.0, 0.0 } });
    }
    LookAtImage(renderer, Side, Side);
    return Cast(renderer, Side, Side, [](vtkPenumbraRayCaster* caster) {
      caster->SetTolerance(Tolerance);
    }).RaysPerPixel;
  };
  EXPECT_NEAR(countRays(1.4), countRays(2.4), 0.01);
}
