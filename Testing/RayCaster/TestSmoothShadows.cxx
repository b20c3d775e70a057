// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Shadows that coarse meshes with interpolated normals cast on themselves. On a convex mesh there are none: light
// ends where the normals turn away from it.
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkClipPolyData.h"
#include "vtkCubeSource.h"
#include "vtkDataArray.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

using namespace penumbra;

namespace
{

constexpr int Side = 96;

/// A sphere, coarse by default.
vtkSmartPointer<vtkPolyData> MakeSphere(int theta = 16, int phi = 12, double radius = 1.0)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(theta);
  source->SetPhiResolution(phi);
  source->SetRadius(radius);
  source->Update();
  return source->GetOutput();
}

/// Adds a light toward the origin.
vtkLight* AddLight(vtkRenderer* renderer, glm::dvec3 from)
{
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(from.x, from.y, from.z);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  renderer->AddLight(light);
  return light;
}

Answer CastScene(vtkRenderer* renderer, bool shadows,
  const std::function<void(vtkPenumbraRayCaster*)>& choose = {})
{
  return Cast(renderer, Side, Side, [&](vtkPenumbraRayCaster* caster) {
    caster->SetTolerance(1.0 / 1024.0);
    caster->SetShadows(shadows);
    if (choose)
    {
      choose(caster);
    }
  });
}

/// Adds a mesh that only casts shadows.
void AddHidden(vtkRenderer* renderer, vtkPolyData* mesh)
{
  vtkProperty* property = AddMesh(renderer, mesh, true)->GetProperty();
  property->FrontfaceCullingOn();
  property->BackfaceCullingOn();
}

/// Returns the largest difference between the images with and without shadows.
double LargestShadow(
  vtkRenderer* renderer, const std::function<void(vtkPenumbraRayCaster*)>& choose = {})
{
  const std::vector<glm::dvec3> without = CastScene(renderer, false).Colors;
  const std::vector<glm::dvec3> with = CastScene(renderer, true, choose).Colors;
  double largest = 0.0;
  double brightest = 0.0;
  for (std::size_t i = 0; i < with.size(); ++i)
  {
    largest = std::max(largest, std::abs(with[i].r - without[i].r));
    brightest = std::max(brightest, without[i].r);
  }
  EXPECT_GT(brightest, 0.7);
  return largest;
}

/// Returns the fraction of the light that reaches each pixel; 1 where there is none without shadows.
std::vector<double> FindVisibleFractions(
  vtkRenderer* renderer, vtkProperty* property, int interpolation)
{
  property->SetInterpolation(interpolation);
  const std::vector<glm::dvec3> without = CastScene(renderer, false).Colors;
  const std::vector<glm::dvec3> with = CastScene(renderer, true).Colors;
  std::vector<double> fractions;
  for (std::size_t i = 0; i < with.size(); ++i)
  {
    fractions.push_back(without[i].r > 0.1 ? with[i].r / without[i].r : 1.0);
  }
  return fractions;
}

/// A sphere whose lit half is seen from the side.
struct SphereScene
{
  vtkSmartPointer<vtkRenderer> Renderer = NewRenderer();
  vtkActor* Actor;
  vtkLight* Light;

  explicit SphereScene(vtkPolyData* mesh = MakeSphere())
    : Actor(AddMesh(this->Renderer, mesh, true)),
      Light(AddLight(this->Renderer, { 9.0, -4.0, 2.0 }))
  {
    this->Actor->GetProperty()->SetInterpolationToGouraud();
    LookAlong(this->Renderer, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 }, Side, Side);
  }
};

constexpr double Rounding = 2.0 / 255.0;

}

TEST(SmoothShadows, EndWhereTheNormalsTurnAway)
{
  const SphereScene scene;
  EXPECT_LE(LargestShadow(scene.Renderer), Rounding);
}

TEST(SmoothShadows, OfFlatMeshesFollowTheirPolygons)
{
  const SphereScene scene;
  scene.Actor->GetProperty()->SetInterpolationToFlat();
  EXPECT_LE(LargestShadow(scene.Renderer), Rounding);
}

TEST(SmoothShadows, EndWhereTheNormalsTurnAwayFromPositionalLights)
{
  const SphereScene scene;
  scene.Light->PositionalOn();
  scene.Light->SetConeAngle(180.0);
  EXPECT_LE(LargestShadow(scene.Renderer), Rounding);
}

TEST(SmoothShadows, EndWhereTheNormalsTurnAwayOnScaledActors)
{
  const SphereScene scene;
  scene.Actor->SetScale(1.0, 1.3, 0.7);
  scene.Actor->RotateX(20.0);
  EXPECT_LE(LargestShadow(scene.Renderer), Rounding);
}

// Where the normals turn away from the center of the light, half of it is still visible: the irradiance is at most
// the sine of its radius there.
TEST(SmoothShadows, EndWhereTheNormalsTurnAwayFromLightsWithASize)
{
  const SphereScene scene;
  const double radius = 3.0; // degrees
  EXPECT_LE(LargestShadow(scene.Renderer,
              [&](vtkPenumbraRayCaster* caster) { caster->SetLightAngle(2.0 * radius); }),
    std::sin(radius * std::acos(-1.0) / 180.0));
}

// The normals of this cube are its diagonals, so that its curved surface is far above the square that floats before it.
TEST(SmoothShadows, KeepShadowsOfWhatTouches)
{
  vtkNew<vtkCubeSource> cube;
  cube->Update();
  vtkPolyData* mesh = cube->GetOutput();
  mesh->GetPointData()->SetNormals(mesh->GetPoints()->GetData());
  vtkNew<vtkPlaneSource> square;
  square->SetOrigin(-0.2, -0.2, 0.51);
  square->SetPoint1(0.2, -0.2, 0.51);
  square->SetPoint2(-0.2, 0.2, 0.51);
  square->Update();

  const vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  vtkProperty* property = AddMesh(renderer, mesh, true)->GetProperty();
  AddHidden(renderer, square->GetOutput());
  AddLight(renderer, { 0.0, 9.0, 9.0 });
  LookAlong(renderer, { 0.0, 0.0, -1.0 }, { 0.0, 1.0, 0.0 }, Side, Side);
  const std::vector<double> flat = FindVisibleFractions(renderer, property, VTK_FLAT);
  const std::vector<double> smooth = FindVisibleFractions(renderer, property, VTK_GOURAUD);
  EXPECT_GT(std::count_if(flat.begin(), flat.end(), [](double v) { return v < 0.01; }), 200);
  for (std::size_t i = 0; i < flat.size(); ++i)
  {
    ASSERT_NEAR(smooth[i], flat[i], 0.02) << "pixel " << i;
  }
}

// The curved surface of the sphere is outside of the shell: what is between a triangle and its curved surface hides the
// light. The shell covers all that faces the sun, and more.
TEST(SmoothShadows, KeepShadowsOfShells)
{
  const vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, MakeSphere(10, 7), true)->GetProperty()->SetInterpolationToGouraud();
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(-0.5, 0.0, 0.0);
  plane->SetNormal(1.0, 0.0, 0.0);
  vtkNew<vtkClipPolyData> shell;
  shell->SetInputData(MakeSphere(100, 80, 1.04));
  shell->SetClipFunction(plane);
  shell->Update();
  AddHidden(renderer, shell->GetOutput());
  AddLight(renderer, { 9.0, 0.0, 0.0 });
  LookAlong(renderer, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 }, Side, Side);
  for (const glm::dvec3& color : CastScene(renderer, true).Colors)
  {
    ASSERT_LE(color.r, Rounding);
  }
}

// The wall is beside all ways from the sphere to the light.
TEST(SmoothShadows, PassWallsBesideALight)
{
  const SphereScene scene;
  scene.Light->SetPosition(3.0, 0.0, 1.0);
  scene.Light->PositionalOn();
  scene.Light->SetConeAngle(180.0);
  vtkNew<vtkPlaneSource> wall;
  wall->SetOrigin(2.8, -2.0, 1.01);
  wall->SetPoint1(2.8, 2.0, 1.01);
  wall->SetPoint2(2.8, -2.0, 3.0);
  wall->Update();
  AddHidden(scene.Renderer, wall->GetOutput());
  EXPECT_LE(LargestShadow(scene.Renderer), Rounding);
}

// Normals on the other side of the square do not let rays start below it. Nothing else is there to cast a shadow.
TEST(SmoothShadows, AreNotCastByASquareWithSlantingNormals)
{
  vtkNew<vtkPlaneSource> square;
  square->Update();
  vtkDataArray* normals = square->GetOutput()->GetPointData()->GetNormals();
  for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
  {
    const bool isLeft = square->GetOutput()->GetPoint(i)[0] < 0.0;
    normals->SetTuple3(i, isLeft ? 0.0 : 0.97, 0.0, isLeft ? 1.0 : -0.24);
  }
  for (const double height : { 0.05, 0.15 })
  {
    const vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
    AddMesh(renderer, square->GetOutput(), true)->GetProperty()->SetInterpolationToGouraud();
    AddLight(renderer, { 1.0, 0.0, height });
    LookAlong(renderer, { 0.0, 0.0, -1.0 }, { 0.0, 1.0, 0.0 }, Side, Side);
    EXPECT_LE(LargestShadow(renderer), Rounding) << height;
  }
}
