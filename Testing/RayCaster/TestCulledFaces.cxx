// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Culled faces are not visible, neither to the camera nor to indirect light, but cast shadows and occlude.
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace penumbra;

namespace
{

constexpr int Side = 25;

/// Adds a white square parallel to the floor with its center at (0, 0, z).
vtkProperty* AddSquare(vtkRenderer* renderer, double side, double z)
{
  vtkNew<vtkPlaneSource> square;
  square->SetOrigin(-0.5 * side, -0.5 * side, z);
  square->SetPoint1(0.5 * side, -0.5 * side, z);
  square->SetPoint2(-0.5 * side, 0.5 * side, z);
  square->Update();
  return AddMesh(renderer, square->GetOutput(), true)->GetProperty();
}

/// Renders a floor below a square whose faces are both culled, from above, with light from above. Returns the color of
/// the floor below the center of the square.
double CastFloor(const std::function<void(vtkPenumbraRayCaster*)>& choose)
{
  const vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddSquare(renderer, 6.0, 0.0);
  vtkProperty* above = AddSquare(renderer, 2.0, 1.0);
  above->BackfaceCullingOn();
  above->FrontfaceCullingOn();
  above->SetDiffuseColor(1.0, 0.0, 0.0);
  LookAlong(renderer, { 0.0, 0.0, -1.0 }, { 0.0, 1.0, 0.0 }, Side, Side);
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(0.0, 0.0, 9.0);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  renderer->AddLight(light);
  const glm::dvec3 color = Cast(renderer, Side, Side, choose).Colors[Side * Side / 2];
  EXPECT_NEAR(color.r, color.g, 1e-3); // the square is red
  return color.g;
}

}

TEST(CulledFaces, AreNotVisible)
{
  EXPECT_NEAR(CastFloor({}), 1.0, 1e-3);
}

TEST(CulledFaces, CastShadows)
{
  EXPECT_NEAR(CastFloor([](vtkPenumbraRayCaster* caster) { caster->ShadowsOn(); }), 0.0, 1e-3);
}

TEST(CulledFaces, Occlude)
{
  // View factor of four squares of side 1 at distance 1, above a common corner.
  const double factor = 4.0 * std::sqrt(0.5) * std::atan(std::sqrt(0.5)) / vtkMath::Pi();
  EXPECT_NEAR(CastFloor([](vtkPenumbraRayCaster* caster) {
    caster->AmbientOcclusionOn();
    caster->SetAmbientOcclusionRadius(100.0);
    caster->SetLightTolerance(0.002);
  }),
    1.0 - factor, 0.02);
}

TEST(CulledFaces, NeitherBlockNorReflectIndirectLight)
{
  EXPECT_NEAR(CastFloor([](vtkPenumbraRayCaster* caster) {
    caster->ShadowsOn();
    caster->IndirectLightOn();
    caster->SetEnvironmentColor(1.0, 1.0, 1.0);
    caster->SetAlbedo(0.5);
  }),
    0.5, 0.02);
}
