// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares materials, lights and cameras with VTK's rasterizer. Also tests shadows and invalid
// input.
#include "Shading/Shading.h"
#include "Surface.h"

#include "ShadingOfActor.h"

#include "vtkCamera.h"
#include "vtkCubeSource.h"
#include "vtkLight.h"
#include "vtkPointData.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"

#include <cmath>
#include <limits>

using namespace penumbra;

TEST_F(ActorShadingTest, MatchesVTKForSmoothShading)
{
  this->SetMesh(Sphere());
  this->Property()->SetColor(.9, .5, .2);
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKForFlatShading)
{
  this->SetMesh(Sphere());
  this->Property()->SetInterpolationToFlat();
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKWithoutNormals)
{
  vtkNew<vtkCubeSource> cube;
  cube->Update();
  cube->GetOutput()->GetPointData()->SetNormals(nullptr);
  this->SetMesh(cube->GetOutput());
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKWithCellNormals)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(Sphere());
  normals->ComputePointNormalsOff();
  normals->ComputeCellNormalsOn();
  normals->Update();
  normals->GetOutput()->GetPointData()->SetNormals(nullptr);
  this->SetMesh(normals->GetOutput());
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKWithAmbientAndSpecular)
{
  this->SetMesh(Sphere());
  this->Property()->SetAmbient(.2);
  this->Property()->SetAmbientColor(.1, .9, .4);
  this->Property()->SetDiffuse(.6);
  this->Property()->SetSpecular(.5);
  this->Property()->SetSpecularColor(1.0, .8, .1);
  this->Property()->SetSpecularPower(15.0);
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKWithoutLighting)
{
  this->SetMesh(Sphere());
  this->Property()->SetAmbient(.3);
  this->Property()->SetDiffuse(.6);
  this->Property()->SetColor(.9, .5, .2);
  this->Property()->LightingOff();
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKWithBackfaceProperty)
{
  this->SetMesh(Sphere());
  this->Property()->SetFrontfaceCulling(true);
  vtkNew<vtkProperty> back;
  back->SetColor(.1, .8, .3);
  back->SetSpecular(.4);
  back->SetSpecularPower(4.0);
  this->Actor->SetBackfaceProperty(back);
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKForMirroredActors)
{
  this->SetMesh(Sphere());
  this->Actor->SetScale(-1.0, 1.2, .8);
  this->Actor->RotateX(20.0);
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKWithLightKit)
{
  this->SetMesh(Sphere());
  this->Property()->SetSpecular(.3);
  this->Property()->SetSpecularPower(8.0);
  vtkNew<vtkLight> key;
  key->SetLightTypeToCameraLight();
  key->SetPosition(1.0, 1.0, .5);
  key->SetColor(1.0, .8, .7);
  key->SetIntensity(.8);
  vtkNew<vtkLight> fill;
  fill->SetLightTypeToSceneLight();
  fill->SetPosition(-3.0, 1.0, 2.0);
  fill->SetIntensity(.5);
  vtkNew<vtkLight> off;
  off->SwitchOff();
  this->Renderer()->AddLight(key);
  this->Renderer()->AddLight(fill);
  this->Renderer()->AddLight(off);
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKWithPositionalLightsAndSpotlights)
{
  this->SetMesh(Sphere());
  this->Property()->SetSpecular(.3);
  this->Property()->SetSpecularPower(8.0);
  vtkNew<vtkLight> light;
  light->PositionalOn();
  light->SetPosition(2.0, 1.0, .5);
  light->SetConeAngle(100.0);
  light->SetAttenuationValues(.5, .2, .1);
  vtkNew<vtkLight> spot;
  spot->PositionalOn();
  spot->SetPosition(0.0, 1.5, 2.0);
  spot->SetFocalPoint(.1, .2, 0.0);
  spot->SetConeAngle(12.0);
  spot->SetExponent(3.0);
  spot->SetColor(.2, .3, 1.0);
  this->Renderer()->AddLight(light);
  this->Renderer()->AddLight(spot);
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKInParallelProjection)
{
  this->SetMesh(Sphere());
  this->Renderer()->GetActiveCamera()->ParallelProjectionOn();
  this->Renderer()->GetActiveCamera()->SetWindowCenter(.2, -.1);
  this->Property()->SetInterpolationToFlat();
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKForHighlightsInParallelProjection)
{
  this->SetMesh(Sphere());
  this->Renderer()->GetActiveCamera()->ParallelProjectionOn();
  this->Property()->SetSpecular(.5);
  this->Property()->SetSpecularPower(6.0);
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(3.0, 1.0, 2.0);
  this->Renderer()->AddLight(light);
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKWithWindowCenterAndHorizontalViewAngle)
{
  this->SetMesh(Sphere());
  this->Renderer()->GetActiveCamera()->SetWindowCenter(.2, -.1);
  this->Renderer()->GetActiveCamera()->UseHorizontalViewAngleOn();
  this->Renderer()->GetActiveCamera()->Roll(20.0);
  this->ExpectSameImage();
}

TEST_F(ActorShadingTest, MatchesVTKOverGradientBackground)
{
  this->SetMesh(Sphere());
  this->Renderer()->GradientBackgroundOn();
  this->Renderer()->SetBackground2(.9, .1, .1);
  this->Property()->SetOpacity(.3);
  this->Property()->BackfaceCullingOn();
  this->ExpectSameImage();
}

namespace
{

/// Returns a floor and a small square above it, lit by a directional light from above.
Scene FloorUnderSquare(float opacity)
{
  Scene scene;
  scene.ViewCamera.Position = { 0.0, -3.0, 3.0 };
  for (const float height : { 0.f, 1.f })
  {
    const float side = height > 0.f ? .5f : 2.f;
    Surface square;
    square.Positions = { { -side, -side, height }, { side, -side, height }, { side, side, height },
      { -side, side, height } };
    square.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
    square.Front.Opacity = height > 0.f ? opacity : 1.f;
    square.Front.Ambient = .1f;
    scene.Surfaces.push_back(square);
  }
  Light light;
  light.Direction = { 0.f, 0.f, -1.f };
  scene.Lights.push_back(light);
  return scene;
}

/// Returns the red channel of the floor at (x, y).
float ShadeFloor(const Scene& scene, bool shadows, float x, float y, long long& rays)
{
  const RayScene traced(scene, 1);
  const Shading shading(traced, shadows);
  const Ray ray{ { x, y, .5f }, { 0.f, 0.f, -1.f } };
  return shading.Shade(ray, traced.Intersect(ray), rays).Color.r;
}

}

TEST(Shading, CastsShadowsOnlyIfEnabled)
{
  long long rays = 0;
  Scene scene = FloorUnderSquare(1.f);
  EXPECT_FLOAT_EQ(ShadeFloor(scene, false, .1f, .2f, rays), 1.1f);
  EXPECT_EQ(rays, 0);
  EXPECT_FLOAT_EQ(ShadeFloor(scene, true, .1f, .2f, rays), .1f);
  EXPECT_FLOAT_EQ(ShadeFloor(scene, true, .6f, .2f, rays), 1.1f);
  EXPECT_EQ(rays, 2);
  scene.Lights[0].CastsShadow = false;
  EXPECT_FLOAT_EQ(ShadeFloor(scene, true, .1f, .2f, rays), 1.1f);
  scene.Lights[0].CastsShadow = true;
  scene.Lights[0].Kind = Light::Kinds::Positional;
  scene.Lights[0].Position = { 0.f, 0.f, .5f }; // below the square
  EXPECT_GT(ShadeFloor(scene, true, .1f, .2f, rays), .8f);
}

TEST(Shading, TransmitsLightThroughTranslucentSurfacesAndLines)
{
  long long rays = 0;
  Scene scene = FloorUnderSquare(.25f);
  EXPECT_NEAR(ShadeFloor(scene, true, .1f, .2f, rays), .85f, 1e-6);
  scene.Surfaces[1].Front.Opacity = 1.f;
  scene.Surfaces[1].IsLineOrPoint = true;
  EXPECT_NEAR(ShadeFloor(scene, true, .1f, .2f, rays), 1.1f, 1e-6);
}

TEST(Shading, TracesOneShadowRayThroughColoredOpaqueSurfaces)
{
  long long rays = 0;
  Scene scene = FloorUnderSquare(1.f);
  scene.Surfaces[1].PointColors.resize(4, glm::u8vec4(200, 100, 50, 255));
  scene.Surfaces.push_back(scene.Surfaces[1]); // a second square above the first one
  for (glm::vec3& position : scene.Surfaces[2].Positions)
  {
    position.z += .5f;
  }
  EXPECT_FLOAT_EQ(ShadeFloor(scene, true, .1f, .2f, rays), .1f);
  EXPECT_EQ(rays, 1);
}

TEST(Shading, DetectsConstantColorPerTriangle)
{
  Scene scene = FloorUnderSquare(1.f);
  const auto isConstant = [&](bool shadows) {
    const RayScene rays(scene, 1);
    return Shading(rays, shadows).IsConstantPerTriangle(0);
  };
  EXPECT_TRUE(isConstant(false));
  EXPECT_FALSE(isConstant(true));
  scene.Surfaces[0].Front.Specular = .5f;
  EXPECT_FALSE(isConstant(false));
  scene.Lights[0].Headlight = true; // shading with one headlight does not depend on the view ray
  EXPECT_TRUE(isConstant(false));
  scene.Lights[0].Headlight = false;
  scene.Surfaces[0].Front.Specular = 0.f;
  scene.Lights[0].Kind = Light::Kinds::Positional;
  EXPECT_FALSE(isConstant(false));
  scene.Surfaces[0].Front.Lighting = false;
  EXPECT_TRUE(isConstant(true));
  scene.Surfaces[0].PointColors.resize(4, glm::u8vec4(255));
  EXPECT_FALSE(isConstant(false));
}

TEST(Shading, IgnoresZeroAndNonFiniteNormals)
{
  Scene scene = FloorUnderSquare(1.f);
  long long rays = 0;
  for (const float bad : { 0.f, std::nanf(""), std::numeric_limits<float>::infinity() })
  {
    scene.Surfaces[0].Normals.assign(4, glm::vec3(bad));
    EXPECT_FLOAT_EQ(ShadeFloor(scene, false, .1f, .2f, rays), 1.1f) << bad;
  }
}
