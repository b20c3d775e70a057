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
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPenumbraEnvironment.h"
#include "vtkPenumbraRayCaster.h"
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
constexpr double Pi = 3.14159265358979323846;

/// Returns the largest difference of the image from `brightness` times the cosine of the normal to `toward`, the
/// diffuse light of a small and distant source, over the pixels inside of the outline.
double LargestDifferenceFromCosine(vtkRenderer* renderer, glm::dvec3 toward, double brightness,
  const std::function<void(vtkPenumbraRayCaster*)>& choose)
{
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(Side, Side);
  caster->SetLightTolerance(1.0 / 256.0);
  caster->IndirectLightOn();
  caster->GeometryArraysOn();
  choose(caster);
  caster->Update();
  vtkPointData* image = caster->GetOutput()->GetPointData();
  vtkDataArray* colors = image->GetArray("Color");
  vtkDataArray* normals = image->GetArray("Normal");
  double largest = 0.0;
  double brightest = 0.0;
  for (int y = 1; y + 1 < Side; ++y)
  {
    for (int x = 1; x + 1 < Side; ++x)
    {
      const vtkIdType i = y * Side + x;
      bool isInside = true;
      for (const int neighbor : { -Side, -1, 0, 1, Side })
      {
        glm::dvec3 normal;
        normals->GetTuple(i + neighbor, &normal.x);
        isInside = isInside && glm::length(normal) > 0.5;
      }
      if (isInside)
      {
        glm::dvec3 normal;
        normals->GetTuple(i, &normal.x);
        const double expected = brightness * std::max(0.0, glm::dot(normal, toward));
        largest = std::max(largest, std::abs(colors->GetComponent(i, 0) - expected));
        brightest = std::max(brightest, expected);
      }
    }
  }
  EXPECT_GT(brightest, 0.7);
  return largest;
}

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

// The sun has four texels of a black map.
TEST(SmoothShadows, EndWhereTheNormalsTurnAwayFromSunsOfTheEnvironment)
{
  const SphereScene scene;
  scene.Light->SetIntensity(0.0);
  constexpr int Rows = 256;
  constexpr double Albedo = 0.8;
  const double solidAngle = 4.0 * (Pi / Rows) * (Pi / Rows);
  vtkNew<vtkImageData> map;
  map->SetDimensions(2 * Rows, Rows, 1);
  map->AllocateScalars(VTK_FLOAT, 1);
  map->GetPointData()->GetScalars()->Fill(0.0);
  for (const int offset : { -1, 0 })
  {
    for (const int column : { Rows - 1, Rows })
    {
      map->SetScalarComponentFromDouble(
        column, Rows / 2 + offset, 0, 0, 0.95 * Pi / (Albedo * solidAngle));
    }
  }
  const glm::dvec3 toward = glm::normalize(glm::dvec3(9.0, -4.0, 2.0));
  vtkNew<vtkPenumbraEnvironment> environment;
  environment->SetImage(map);
  environment->SetUp(-2.0, 0.0, 9.0);
  environment->SetRight(toward.x, toward.y, toward.z);
  EXPECT_LE(LargestDifferenceFromCosine(scene.Renderer, toward, 0.95,
              [&](vtkPenumbraRayCaster* caster) {
                caster->SetEnvironment(environment);
                caster->SetAlbedo(Albedo);
              }),
    2.0 * std::sin(Pi / Rows) + Rounding);
}

// Where the normals turn away from the center of the emitter, half of it is still visible.
TEST(SmoothShadows, EndWhereTheNormalsTurnAwayFromEmitters)
{
  const SphereScene scene;
  scene.Light->SetIntensity(0.0);
  constexpr double Distance = 400.0;
  constexpr double Radius = 8.0;
  constexpr double Albedo = 0.8;
  const glm::dvec3 toward = glm::normalize(glm::dvec3(9.0, -4.0, 2.0));
  vtkActor* emitter = AddMesh(scene.Renderer, MakeSphere(24, 16, Radius), true);
  const glm::dvec3 center = Distance * toward;
  emitter->SetPosition(center.x, center.y, center.z);
  emitter->GetProperty()->SetDiffuse(0.0);
  emitter->GetProperty()->SetAmbient(1.0);
  const double radiance = 0.95 / (Albedo * Radius * Radius / (Distance * Distance));
  emitter->GetProperty()->SetAmbientColor(radiance, radiance, radiance);
  EXPECT_LE(LargestDifferenceFromCosine(scene.Renderer, toward, 0.95,
              [&](vtkPenumbraRayCaster* caster) {
                caster->SetEnvironmentColor(0.0, 0.0, 0.0);
                caster->SetAlbedo(Albedo);
              }),
    0.05);
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
