// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Light shafts estimated from shadow maps, against the ray-marched reference of the ray caster.
#include "ShaftScene.h"
#include "vtkPenumbraMedium.h"
#include "vtkPenumbraShaftConstants.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMapper.h"
#include "vtkPointData.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>

namespace
{

using Pass = vtkPenumbraLightShaftPass;

constexpr double WholeSphere = 12.566370614359172;

double RelativeRmse(const std::vector<double>& values, const std::vector<double>& reference)
{
  double squares = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < reference.size(); ++i)
  {
    squares += (values[i] - reference[i]) * (values[i] - reference[i]);
    size += reference[i] * reference[i];
  }
  return std::sqrt(squares / size);
}

/// Returns the fraction of pixels that are off by more than 0.1 of the light that 95 % of them do not
/// reach.
double FractionOff(const std::vector<double>& values, const std::vector<double>& reference)
{
  std::vector<double> sorted = reference;
  std::sort(sorted.begin(), sorted.end());
  const double scale = sorted[sorted.size() * 95 / 100];
  int off = 0;
  for (std::size_t i = 0; i < reference.size(); ++i)
  {
    off += std::abs(values[i] - reference[i]) > 0.1 * scale;
  }
  return static_cast<double>(off) / static_cast<double>(reference.size());
}

/// Posts in haze, in one actor.
class ShaftShadowMaps : public ::testing::Test
{
protected:
  static std::unique_ptr<ShaftScene> MakeComb(int width)
  {
    auto scene = std::make_unique<ShaftScene>(width, width * 3 / 4);
    scene->AddComb(12);
    scene->Look({ 0.5, -11.0, 2.5 }, { 0.0, 0.0, 2.0 });
    scene->SetMedium(0.12, 0.12);
    scene->Pass->SetEstimatorToShadowMap();
    return scene;
  }

  double Statistic(const char* name)
  {
    return this->Scene->Pass->GetStatistics()->GetArray(name)->GetTuple1(0);
  }

  std::unique_ptr<ShaftScene> Scene = MakeComb(128);
};

}

TEST_F(ShaftShadowMaps, FollowTheToleranceForOneActor)
{
  this->Scene = MakeComb(256);
  this->Scene->AddSun({ 0.2, 1.0, 0.32 });
  const std::vector<double> reference = this->Scene->RenderWithRayCaster(512);
  const double tolerances[3] = { 1.0 / 64.0, 1.0 / 256.0, 1.0 / 1024.0 };
  const double errors[3] = { 0.03, 0.015, 0.005 };
  for (int i = 0; i < 3; ++i)
  {
    this->Scene->Pass->SetTolerance(tolerances[i]);
    EXPECT_LT(RelativeRmse(this->Scene->RenderWithPass(), reference), errors[i]) << i;
  }
  // One layer of depth does not separate the posts, at any tolerance.
  this->Scene->Pass->SetEstimatorToDepth();
  EXPECT_GT(RelativeRmse(this->Scene->RenderWithPass(), reference), 0.1);
}

TEST_F(ShaftShadowMaps, MatchEquationOneOverAFloor)
{
  ShaftScene scene(48, 36);
  scene.Pass->SetEstimatorToShadowMap();
  scene.AddFloor(20.0);
  scene.Look({ 0.0, -6.0, 3.0 }, { 0.0, 0.0, 1.0 });
  scene.AddSun({ 0.3, 0.2, 1.0 });
  scene.SetMedium(0.1, 0.25);
  const std::vector<double> light = scene.RenderWithPass();
  const std::vector<double> left = scene.Transmittance();
  for (std::size_t i = 0; i < light.size(); ++i)
  {
    const double exact = 0.1 / 0.25 / WholeSphere * (1.0 - left[i]);
    EXPECT_NEAR(light[i], exact, 0.01 * exact);
  }
}

TEST_F(ShaftShadowMaps, MatchTheReferenceInParallelProjectionAndABoundedMedium)
{
  this->Scene->AddSun({ 1.0, 0.6, 0.9 });
  this->Scene->Look({ 0.5, -9.0, 8.0 }, { 0.0, 0.0, 1.0 });
  vtkCamera* camera = this->Scene->Renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(3.5);
  EXPECT_LT(
    RelativeRmse(this->Scene->RenderWithPass(), this->Scene->RenderWithRayCaster(96)), 0.02);
  camera->ParallelProjectionOff();
  this->Scene->Look({ 0.5, -11.0, 2.5 }, { 0.0, 0.0, 2.0 });
  this->Scene->Pass->GetMedium()->SetBounds(-5.0, 3.0, -6.0, 7.0, 0.0, 4.5);
  EXPECT_LT(
    RelativeRmse(this->Scene->RenderWithPass(), this->Scene->RenderWithRayCaster(96)), 0.03);
}

TEST_F(ShaftShadowMaps, MatchTheReferenceForPositionalLights)
{
  const vtkSmartPointer<vtkLight> light = this->Scene->AddLamp({ 1.0, 7.0, 10.0 });
  EXPECT_LT(
    RelativeRmse(this->Scene->RenderWithPass(), this->Scene->RenderWithRayCaster(96)), 0.015);
  EXPECT_EQ(this->Statistic("ShadowMaps/Rendered"), 1.0);
  // A spotlight inside the bounds, with a box behind it.
  this->Scene->AddBox({ 0.0, 9.0, 13.0 }, { 1.0, 1.0, 1.0 });
  light->SetPosition(1.0, 6.0, 8.0);
  light->SetFocalPoint(0.0, 0.0, 1.5);
  light->SetConeAngle(60.0);
  light->SetExponent(8.0); // without a visible edge of the cone
  EXPECT_LT(
    RelativeRmse(this->Scene->RenderWithPass(), this->Scene->RenderWithRayCaster(96)), 0.025);
  EXPECT_EQ(this->Statistic("ShadowMaps/Rendered"), 1.0);
}

TEST_F(ShaftShadowMaps, MatchTheReferenceAroundAVisibleSpotlight)
{
  this->Scene = MakeComb(256);
  const vtkSmartPointer<vtkLight> light = this->Scene->AddLamp({ 0.0, 2.0, 5.0 });
  light->SetFocalPoint(0.0, 0.0, 0.5);
  light->SetConeAngle(60.0);
  light->SetExponent(0.0);
  const std::vector<double> reference = this->Scene->RenderWithRayCaster(256);
  const std::vector<double> image = this->Scene->RenderWithPass();
  EXPECT_LT(RelativeRmse(image, reference), 0.02);
  EXPECT_LT(FractionOff(image, reference), 0.001);
}

TEST_F(ShaftShadowMaps, MatchTheReferenceForASunBehindTheCamera)
{
  this->Scene = MakeComb(256);
  this->Scene->AddSun({ 0.05, -1.0, 0.2 });
  const std::vector<double> reference = this->Scene->RenderWithRayCaster(256);
  EXPECT_LT(FractionOff(this->Scene->RenderWithPass(), reference), 0.004);
  this->Scene->Pass->SetEstimatorToDepth();
  EXPECT_GT(FractionOff(this->Scene->RenderWithPass(), reference), 0.02);
}

TEST_F(ShaftShadowMaps, AreReplacedByDepthForALightInsideTheScene)
{
  const vtkSmartPointer<vtkLight> light = this->Scene->AddLamp({ 0.5, 3.0, 3.0 });
  std::string warnings;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&warnings);
  observer->SetCallback([](vtkObject*, unsigned long, void* text, void* message) {
    *static_cast<std::string*>(text) += static_cast<const char*>(message);
  });
  this->Scene->Pass->AddObserver(vtkCommand::WarningEvent, observer);
  const std::vector<double> replaced = this->Scene->RenderWithPass();
  EXPECT_NE(warnings.find("cone angle of at most 80 degrees"), std::string::npos);
  const std::string once = warnings;
  EXPECT_EQ(this->Statistic("ShadowMaps/Rendered"), 0.0);
  this->Scene->Pass->SetEstimatorToDepth();
  EXPECT_EQ(this->Scene->RenderWithPass(), replaced);
  EXPECT_EQ(warnings, once);
  // A directional light next to it has its map.
  this->Scene->Pass->SetEstimatorToShadowMap();
  this->Scene->AddSun({ 0.2, 1.0, 0.32 });
  this->Scene->RenderWithPass();
  EXPECT_EQ(this->Statistic("ShadowMaps/Rendered"), 1.0);
}

TEST_F(ShaftShadowMaps, ShowShaftsOfOccludersOutsideOfTheImage)
{
  this->Scene->AddSun({ 0.2, 0.5, 1.0 });
  const std::vector<double> without = this->Scene->RenderWithPass();
  // Above the image, toward the light.
  const vtkSmartPointer<vtkActor> ball = this->Scene->AddSphere({ 1.0, 2.0, 10.0 }, 1.5);
  const std::vector<double> with = this->Scene->RenderWithPass();
  // A static scene is computed once.
  EXPECT_GT(this->Statistic("LitFractions/Computed"), 0.0);
  EXPECT_EQ(this->Scene->RenderWithPass(), with);
  EXPECT_EQ(this->Statistic("LitFractions/Computed"), 0.0);
  EXPECT_EQ(this->Scene->RenderWithPass(), with);
  // No depth in the image changes when the ball moves or its mesh grows.
  ball->SetPosition(-2.0, 0.0, 0.0);
  const std::vector<double> moved = this->Scene->RenderWithPass();
  EXPECT_GT(this->Statistic("LitFractions/Computed"), 0.0);
  this->Scene->RenderWithPass();
  vtkSphereSource::SafeDownCast(ball->GetMapper()->GetInputAlgorithm())->SetRadius(1.0);
  const std::vector<double> smaller = this->Scene->RenderWithPass();
  EXPECT_GT(this->Statistic("LitFractions/Computed"), 0.0);
  EXPECT_LT(RelativeRmse(smaller, this->Scene->RenderWithRayCaster(96)), 0.02);
  EXPECT_GT(RelativeRmse(without, smaller), 0.03);
  EXPECT_GT(RelativeRmse(moved, smaller), 0.02);
  EXPECT_GT(RelativeRmse(with, moved), 0.05);
}

TEST_F(ShaftShadowMaps, GiveMovingViewsTheImageOfAStaticOne)
{
  this->Scene->AddSun({ 0.2, 1.0, 0.32 });
  vtkCamera* camera = this->Scene->Renderer->GetActiveCamera();
  std::vector<double> last;
  double maps = 0.0;
  for (int frame = 0; frame < 8; ++frame)
  {
    camera->Azimuth(0.5);
    last = this->Scene->RenderWithPass();
    EXPECT_GT(this->Statistic("LitFractions/Computed"), 0.0);
    maps += this->Statistic("ShadowMaps/Rendered");
  }
  EXPECT_LT(maps, 4.0); // not one per frame
  EXPECT_EQ(this->Scene->RenderWithPass(), last);
  const std::unique_ptr<ShaftScene> fresh = MakeComb(128);
  fresh->AddSun({ 0.2, 1.0, 0.32 });
  fresh->Renderer->GetActiveCamera()->DeepCopy(camera);
  EXPECT_EQ(fresh->RenderWithPass(), last);
}

TEST_F(ShaftShadowMaps, ContainOnlyWhatTheViewNeeds)
{
  // A narrow view of a part of a large floor with fine posts.
  this->Scene->AddFloor(200.0);
  this->Scene->AddSun({ 0.2, 1.0, 0.9 });
  this->Scene->Look({ 0.5, -11.0, 4.0 }, { 0.0, 0.0, 1.0 }, 20.0);
  EXPECT_LT(
    RelativeRmse(this->Scene->RenderWithPass(), this->Scene->RenderWithRayCaster(96)), 0.05);
}

TEST_F(ShaftShadowMaps, RestoreTheCamera)
{
  this->Scene->AddSun({ 0.2, 1.0, 0.32 });
  vtkCamera* camera = this->Scene->Renderer->GetActiveCamera();
  this->Scene->Renderer->ResetCameraClippingRange();
  const vtkMTimeType time = camera->GetMTime();
  this->Scene->RenderWithPass();
  EXPECT_EQ(this->Scene->Renderer->GetActiveCamera(), camera);
  EXPECT_EQ(camera->GetMTime(), time);
  EXPECT_FALSE(camera->GetUseExplicitProjectionTransformMatrix());
}

TEST_F(ShaftShadowMaps, LeaveTheShadingOfPropsUnchanged)
{
  // Practically without a medium; a lit box in front, and a translucent one.
  this->Scene->SetMedium(1e-9, 1e-9);
  this->Scene->AddSun({ 0.2, -1.0, 0.6 });
  const vtkSmartPointer<vtkActor> box = this->Scene->AddBox({ -1.0, -3.0, 1.0 }, { 1.0, 1.0, 1.0 });
  const vtkSmartPointer<vtkActor> pane = this->Scene->AddBox({ 1.0, -3.0, 1.0 }, { 1.0, 1.0, 1.0 });
  for (vtkActor* actor : { box.Get(), pane.Get() })
  {
    actor->GetProperty()->SetColor(1.0, 0.6, 0.2);
    actor->GetProperty()->LightingOn();
  }
  pane->GetProperty()->SetOpacity(0.5);
  const auto render = [this]() {
    vtkNew<vtkUnsignedCharArray> bytes;
    this->Scene->Window->Render();
    this->Scene->Window->GetRGBACharPixelData(
      0, 0, this->Scene->Width - 1, this->Scene->Height - 1, 0, bytes);
    return std::vector<unsigned char>(
      bytes->GetPointer(0), bytes->GetPointer(0) + bytes->GetNumberOfValues());
  };
  this->Scene->Pass->SetEstimatorToDepth();
  this->Scene->Pass->GetConstants().Margin = 0.0;
  const std::vector<unsigned char> expected = render();
  this->Scene->Pass->SetEstimatorToShadowMap();
  for (int frame = 0; frame < 5; ++frame)
  {
    EXPECT_EQ(render(), expected) << frame;
    EXPECT_EQ(this->Statistic("ShadowMaps/Rendered"), frame % 3 == 0 ? 1.0 : 0.0);
    if (frame == 2)
    {
      box->Modified(); // the map is rendered again
    }
  }
}

TEST_F(ShaftShadowMaps, LeaveTheDepthEstimatorUnchanged)
{
  this->Scene->AddSun({ 0.2, 1.0, 0.32 });
  this->Scene->Pass->SetEstimatorToDepth();
  const std::vector<double> before = this->Scene->RenderWithPass();
  EXPECT_EQ(this->Statistic("ShadowMaps/Size"), 0.0);
  this->Scene->Pass->SetEstimatorToShadowMap();
  EXPECT_NE(this->Scene->RenderWithPass(), before);
  EXPECT_EQ(this->Statistic("ShadowMaps/Size"), 512.0);
  this->Scene->Pass->SetEstimatorToDepth();
  EXPECT_EQ(this->Scene->RenderWithPass(), before);
}

TEST_F(ShaftShadowMaps, AreFiniteForDegenerateScenes)
{
  const vtkSmartPointer<vtkLight> sun = this->Scene->AddSun({ 0.0, 0.0, 1.0 });
  ShaftScene plane(48, 36); // in the light's direction
  plane.Pass->SetEstimatorToShadowMap();
  plane.AddFloor(1.0);
  plane.AddSun({ 1.0, 0.0, 0.0 });
  plane.Look({ 0.0, -6.0, 3.0 }, { 0.0, 0.0, 0.0 });
  for (ShaftScene* scene : { this->Scene.get(), &plane })
  {
    for (const double value : scene->RenderWithPass())
    {
      ASSERT_TRUE(value >= 0.0 && value < 1.0);
    }
  }
  // A spotlight without a direction.
  sun->PositionalOn();
  sun->SetPosition(0.0, 3.0, 3.0);
  sun->SetFocalPoint(0.0, 3.0, 3.0);
  sun->SetConeAngle(45.0);
  for (const double value : this->Scene->RenderWithPass())
  {
    ASSERT_TRUE(value >= 0.0 && value < 1.0);
  }
}

TEST_F(ShaftShadowMaps, ArePrintedByName)
{
  std::ostringstream text;
  this->Scene->Pass->PrintSelf(text, vtkIndent());
  EXPECT_NE(text.str().find("Estimator: ShadowMap"), std::string::npos);
  this->Scene->Pass->SetEstimatorToRadial();
  EXPECT_STREQ(this->Scene->Pass->GetEstimatorAsString(), "Radial");
  this->Scene->Pass->SetEstimator(7);
  EXPECT_EQ(this->Scene->Pass->GetEstimator(), Pass::SHADOW_MAP);
}
