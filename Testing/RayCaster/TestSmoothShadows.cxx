// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Shadows that coarse meshes with interpolated normals cast on themselves. On a convex mesh there are none: light
// ends where the normals turn away from it.
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCubeSource.h"
#include "vtkLight.h"
#include "vtkNew.h"
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

/// A coarse sphere.
vtkSmartPointer<vtkPolyData> MakeSphere()
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(16);
  source->SetPhiResolution(12);
  source->SetRadius(1.0);
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
  vtkProperty* floating = AddMesh(renderer, square->GetOutput(), true)->GetProperty();
  floating->FrontfaceCullingOn();
  floating->BackfaceCullingOn();
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
