// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The light shaft pass against closed forms and against the ray-marched reference of the ray
// caster.
#include "ShaftScene.h"
#include "vtkPenumbraMedium.h"
#include "vtkPenumbraShaftConstants.h"

#include "vtkPenumbraTemporalSSAOPass.h"

#include "vtkActorCollection.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkProperty.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace
{

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

/// 96 x 72 pixels of solids over a floor.
class LightShaftPass : public ::testing::Test
{
protected:
  LightShaftPass()
    : Scene(96, 72)
  {
    this->Scene.AddFloor(12.0);
    this->Scene.AddSolids(10, 2);
    this->Scene.Look({ 0.5, -11.0, 2.5 }, { 0.0, 0.0, 2.0 });
    this->Scene.SetMedium(0.12, 0.12);
  }

  std::vector<unsigned char> Image()
  {
    vtkNew<vtkUnsignedCharArray> bytes;
    this->Scene.Window->Render();
    this->Scene.Window->GetRGBACharPixelData(
      0, 0, this->Scene.Width - 1, this->Scene.Height - 1, 0, bytes);
    return { bytes->GetPointer(0), bytes->GetPointer(0) + bytes->GetNumberOfValues() };
  }

  double Statistic(const char* name)
  {
    return this->Scene.Pass->GetStatistics()->GetArray(name)->GetTuple1(0);
  }

  ShaftScene Scene;
};

}

TEST(LightShaftPassOverAFloor, MatchesEquationOne)
{
  ShaftScene scene(48, 36);
  scene.AddFloor(20.0);
  scene.Look({ 0.0, -6.0, 3.0 }, { 0.0, 0.0, 1.0 });
  scene.AddSun({ 0.3, 0.2, 1.0 });
  scene.SetMedium(0.1, 0.25);
  const std::vector<double> light = scene.RenderWithPass();
  const std::vector<double> left = scene.Transmittance();
  const std::vector<double> reference = scene.RenderWithRayCaster();
  for (std::size_t i = 0; i < light.size(); ++i)
  {
    const double exact = 0.1 / 0.25 / WholeSphere * (1.0 - left[i]);
    EXPECT_NEAR(reference[i], exact, 1e-5);
    // One bin of 64 may be treated as shadow where the ray meets the floor.
    EXPECT_NEAR(light[i], exact, exact / 64.0 + 1e-5);
  }
}

TEST_F(LightShaftPass, MatchesRayMarchedReference)
{
  this->Scene.AddSun({ 0.2, 1.0, 0.32 });
  const std::vector<double> light = this->Scene.RenderWithPass();
  const std::vector<double> reference = this->Scene.RenderWithRayCaster(64);
  std::vector<double> unshadowed = this->Scene.Transmittance();
  for (double& value : unshadowed)
  {
    value = (1.0 - value) / WholeSphere;
  }
  const double error = RelativeRmse(light, reference);
  EXPECT_LT(error, 0.025);
  EXPECT_LT(error, 0.25 * RelativeRmse(unshadowed, reference));
}

TEST_F(LightShaftPass, MatchesReferenceForPositionalLightAndParallelProjection)
{
  this->Scene.AddLamp({ 1.0, 2.0, 3.0 });
  EXPECT_LT(RelativeRmse(this->Scene.RenderWithPass(), this->Scene.RenderWithRayCaster(64)), 0.08);
  this->Scene.Renderer->RemoveAllLights();
  this->Scene.AddSun({ 1.0, 0.6, 0.9 });
  this->Scene.Look({ 0.5, -9.0, 8.0 }, { 0.0, 0.0, 1.0 });
  this->Scene.Renderer->GetActiveCamera()->ParallelProjectionOn();
  this->Scene.Renderer->GetActiveCamera()->SetParallelScale(3.5);
  EXPECT_LT(RelativeRmse(this->Scene.RenderWithPass(), this->Scene.RenderWithRayCaster(64)), 0.05);
}

TEST_F(LightShaftPass, MatchesPhaseFunctionsOfTheReference)
{
  this->Scene.AddSun({ 0.2, 1.0, 0.32 });
  for (const int phase : { vtkPenumbraMedium::RAYLEIGH, vtkPenumbraMedium::HENYEY_GREENSTEIN })
  {
    this->Scene.Pass->GetMedium()->SetPhase(phase);
    EXPECT_LT(RelativeRmse(this->Scene.RenderWithPass(), this->Scene.RenderWithRayCaster(64)), 0.03)
      << phase;
  }
}

TEST_F(LightShaftPass, AddsLights)
{
  const vtkSmartPointer<vtkLight> sun = this->Scene.AddSun({ 0.2, 1.0, 0.32 });
  const vtkSmartPointer<vtkLight> positional = this->Scene.AddLamp({ 1.0, 2.0, 3.0 });
  this->Scene.Pass->GetConstants().Margin =
    0.0; // otherwise the margin for a light outside of the image would apply to all lights
  const std::vector<double> both = this->Scene.RenderWithPass();
  this->Scene.Pass->AddLight(positional);
  const std::vector<double> one = this->Scene.RenderWithPass();
  this->Scene.Pass->RemoveAllLights();
  this->Scene.Pass->AddLight(sun);
  const std::vector<double> other = this->Scene.RenderWithPass();
  for (std::size_t i = 0; i < both.size(); ++i)
  {
    EXPECT_NEAR(both[i], one[i] + other[i], 1e-6 + 2e-4 * both[i]);
  }
}

TEST_F(LightShaftPass, ComputesAStaticSceneOnce)
{
  const vtkSmartPointer<vtkLight> sun = this->Scene.AddSun({ 0.2, 1.0, 0.32 });
  const std::vector<unsigned char> first = this->Image();
  EXPECT_GT(this->Statistic("LitFractions/Computed"), 0.0);
  EXPECT_EQ(this->Image(), first);
  EXPECT_EQ(this->Statistic("LitFractions/Computed"), 0.0);
  sun->SetPosition(0.3, 1.0, 0.32);
  EXPECT_NE(this->Image(), first);
  EXPECT_GT(this->Statistic("LitFractions/Computed"), 0.0);
}

TEST_F(LightShaftPass, ComputesASceneOnceWhoseColorsChange)
{
  this->Scene.AddSun({ 0.2, 1.0, 0.32 });
  const vtkSmartPointer<vtkActor> ball = this->Scene.AddSphere({ 0.0, -3.0, 2.0 }, 0.5);
  for (int frame = 0; frame < 6; ++frame)
  {
    ball->AddPosition(0.05, 0.0, 0.0);
    this->Image();
    EXPECT_GT(this->Statistic("LitFractions/Computed"), 0.0);
  }
  // While actors move, the depths are compared in one of eight frames, and the result is known four
  // frames later.
  for (int frame = 0; frame < 14; ++frame)
  {
    ball->GetProperty()->SetColor(0.0, 0.05 * frame, 0.0);
    this->Image();
  }
  EXPECT_EQ(this->Statistic("LitFractions/Computed"), 0.0);
}

TEST_F(LightShaftPass, RendersAStaticSceneWithMarginDirectlyIntoItsTarget)
{
  this->Scene.Renderer->SetBackground(0.2, 0.4, 0.6);
  this->Scene.AddSun({ 0.8, 1.0, 0.32 });
  const vtkSmartPointer<vtkActor> ball = this->Scene.AddSphere({ 0.0, -3.0, 2.0 }, 0.5);
  const std::vector<unsigned char> first = this->Image();
  const std::vector<unsigned char> second = this->Image();
  EXPECT_EQ(this->Statistic("LitFractions/Computed"), 0.0);
  EXPECT_EQ(this->Image(), second);
  // In a wider image the position of an edge may be rounded differently.
  int apart = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    apart += first[i] != second[i];
  }
  EXPECT_LT(apart, static_cast<int>(first.size() / 100));
  // The actor moves without modifying the camera. The pass detects it from the depth buffer.
  ball->SetPosition(0.5, 0.0, 0.0);
  const std::vector<unsigned char> moved = this->Image();
  EXPECT_GT(this->Statistic("LitFractions/Computed"), 0.0);
  vtkPenumbraLightShaftPass::RemoveFrom(this->Scene.Renderer);
  this->Scene.Pass = vtkPenumbraLightShaftPass::AddTo(this->Scene.Renderer);
  this->Scene.SetMedium(0.12, 0.12);
  EXPECT_EQ(this->Image(), moved);
}

TEST_F(LightShaftPass, CombinesManyDirectionalAndPositionalLights)
{
  this->Scene.Pass->GetConstants().Margin = 0.0;
  std::vector<vtkSmartPointer<vtkLight>> lights;
  for (int i = 0; i < 4; ++i)
  {
    lights.push_back(this->Scene.AddSun({ 0.2 * i - 0.3, 1.0, 0.32 }));
    lights.push_back(this->Scene.AddLamp({ 2.0 * i - 3.0, 2.0, 3.0 }));
  }
  const std::vector<double> all = this->Scene.RenderWithPass();
  std::vector<double> sum(all.size(), 0.0);
  for (vtkLight* light : lights)
  {
    this->Scene.Pass->RemoveAllLights();
    this->Scene.Pass->AddLight(light);
    const std::vector<double> one = this->Scene.RenderWithPass();
    std::transform(one.begin(), one.end(), sum.begin(), sum.begin(), std::plus<double>());
  }
  EXPECT_LT(RelativeRmse(all, sum), 1e-5);
}

TEST_F(LightShaftPass, AttenuatesTheImageBehind)
{
  // A white wall fills the view. The camera receives exp(-0.12 * 6) of it and the in-scattered
  // light.
  ShaftScene scene(40, 30);
  const vtkSmartPointer<vtkActor> wall = scene.AddBox({ 0.0, 0.5, 0.0 }, { 30.0, 1.0, 30.0 });
  wall->GetProperty()->SetColor(1.0, 1.0, 1.0);
  scene.Look({ 0.0, -6.0, 0.0 }, { 0.0, 0.0, 0.0 });
  scene.AddSun({ 0.0, -1.0, 0.5 });
  scene.SetMedium(0.12, 0.12);
  scene.Window->Render();
  vtkNew<vtkUnsignedCharArray> bytes;
  scene.Window->GetRGBACharPixelData(0, 0, 39, 29, 0, bytes);
  const double left = std::exp(-0.12 * 6.0);
  const double expected = left + (1.0 - left) / WholeSphere;
  EXPECT_NEAR(bytes->GetTypedComponent(15 * 40 + 20, 0) / 255.0, expected, 0.006);
}

TEST_F(LightShaftPass, IsFiniteForAnyLightPosition)
{
  const vtkSmartPointer<vtkLight> sun = this->Scene.AddSun({ 0.0, 1.0, 0.0 });
  for (const int estimator : { vtkPenumbraLightShaftPass::DEPTH, vtkPenumbraLightShaftPass::RADIAL,
         vtkPenumbraLightShaftPass::SHADOW_MAP })
  {
    this->Scene.Pass->SetEstimator(estimator);
    for (int angle = 0; angle < 360; angle += 30)
    {
      const double a = angle * 0.017453292519943295;
      sun->SetPosition(std::sin(a), std::cos(a), 0.0);
      for (const double value : this->Scene.RenderWithPass())
      {
        ASSERT_TRUE(value >= 0.0 && value < 1.0) << angle;
      }
    }
  }
}

TEST_F(LightShaftPass, ReplacesTheMediumByADefaultOne)
{
  vtkPenumbraLightShaftPass* pass = this->Scene.Pass;
  const vtkSmartPointer<vtkPenumbraMedium> before = pass->GetMedium();
  const vtkMTimeType time = pass->GetMTime();
  pass->SetMedium(nullptr);
  EXPECT_GT(pass->GetMTime(), time);
  ASSERT_NE(pass->GetMedium(), nullptr);
  EXPECT_NE(pass->GetMedium(), before);
  EXPECT_EQ(pass->GetMedium()->GetScattering(), -1.0);
  pass->SetMedium(before);
  EXPECT_EQ(pass->GetMedium(), before);
}

TEST_F(LightShaftPass, GivesEachWarningOnce)
{
  const vtkSmartPointer<vtkLight> sun = this->Scene.AddSun({ 0.2, 1.0, 0.32 });
  const std::vector<unsigned char> plain = this->Image();
  vtkNew<vtkImageData> density;
  this->Scene.Pass->GetMedium()->SetDensity(density);
  int warnings = 0;
  vtkNew<vtkCallbackCommand> count;
  count->SetClientData(&warnings);
  count->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*) { ++*static_cast<int*>(data); });
  this->Scene.Pass->AddObserver(vtkCommand::WarningEvent, count);
  EXPECT_EQ(this->Image(), plain);
  EXPECT_EQ(this->Image(), plain);
  EXPECT_EQ(warnings, 1);
  // From now on, every frame finds two reasons to warn.
  this->Scene.Renderer->RemoveLight(sun);
  for (int frame = 0; frame < 3; ++frame)
  {
    this->Scene.Window->Render();
    EXPECT_EQ(warnings, 2);
  }
}

TEST_F(LightShaftPass, LeavesTheSceneUnchangedOnInvalidInput)
{
  const vtkSmartPointer<vtkLight> sun = this->Scene.AddSun({ 0.2, 1.0, 0.32 });
  this->Scene.Renderer->SetBackground(0.2, 0.4, 0.6);
  const std::vector<unsigned char> foggy = this->Image();
  vtkPenumbraLightShaftPass::RemoveFrom(this->Scene.Renderer);
  EXPECT_EQ(this->Scene.Renderer->GetPass(), nullptr);
  const std::vector<unsigned char> plain = this->Image();
  EXPECT_NE(foggy, plain);

  vtkPenumbraLightShaftPass* pass = vtkPenumbraLightShaftPass::AddTo(this->Scene.Renderer);
  pass->GetMedium()->SetScattering(std::numeric_limits<double>::infinity());
  EXPECT_EQ(this->Image(), plain);
  pass->GetMedium()->SetScattering(0.12);
  sun->SetIntensity(0.0);
  EXPECT_EQ(this->Image(), plain);
  sun->SetIntensity(std::numeric_limits<double>::infinity());
  EXPECT_EQ(this->Image(), plain);
  sun->SetIntensity(1.0);
  pass->GetMedium()->SetBounds(1.0, -1.0, 0.0, 1.0, 0.0, 1.0);
  EXPECT_EQ(this->Image(), plain);
  const double endless = std::numeric_limits<double>::infinity();
  pass->GetMedium()->SetBounds(-endless, endless, -endless, endless, -endless, endless);
  EXPECT_NE(this->Image(), plain);
  // A positional light at the camera's position.
  sun->PositionalOn();
  sun->SetPosition(this->Scene.Renderer->GetActiveCamera()->GetPosition());
  EXPECT_EQ(this->Image(), plain);
  // A light at the largest finite distance.
  sun->PositionalOff();
  sun->SetPosition(1e30, 5e30, 1.6e30);
  EXPECT_NE(this->Image(), plain);
  this->Scene.Renderer->SetViewport(0.5, 0.5, 0.5, 0.5);
  this->Image();
}

TEST_F(LightShaftPass, MatchesReferenceInABoundedMedium)
{
  this->Scene.Pass->GetMedium()->SetBounds(-5.0, 3.0, -6.0, 7.0, 0.0, 4.5);
  this->Scene.SetMedium(0.2, 0.3);
  const vtkSmartPointer<vtkLight> sun = this->Scene.AddSun({ 0.2, 1.0, 0.5 });
  EXPECT_LT(RelativeRmse(this->Scene.RenderWithPass(), this->Scene.RenderWithRayCaster(64)), 0.06);
  this->Scene.Renderer->RemoveAllLights();
  this->Scene.AddLamp({ 1.0, 2.0, 3.0 });
  EXPECT_LT(RelativeRmse(this->Scene.RenderWithPass(), this->Scene.RenderWithRayCaster(64)), 0.08);
}

TEST_F(LightShaftPass, ChainsPassesEquivalentToOneLongLoop)
{
  this->Scene.AddSun({ 0.1, 1.0, 0.1 });
  this->Scene.Pass->SetEstimator(vtkPenumbraLightShaftPass::RADIAL);
  this->Scene.Pass->GetConstants().Spacing = penumbra::ShaftSpacings::Geometric;
  this->Scene.Pass->GetConstants().Decay = 0.99;
  this->Scene.Pass->GetConstants().Steps = 64;
  const std::vector<double> loop = this->Scene.RenderWithPass();
  this->Scene.Pass->GetConstants().Steps = 8;
  const std::vector<double> few = this->Scene.RenderWithPass();
  this->Scene.Pass->GetConstants().Passes = 2;
  const std::vector<double> chain = this->Scene.RenderWithPass();
  EXPECT_LT(RelativeRmse(chain, loop), 0.01);
  EXPECT_GT(RelativeRmse(few, loop), 0.02);
}

TEST_F(LightShaftPass, ScattersTheColorsOfTheImageBehind)
{
  this->Scene.AddSun({ 0.1, 1.0, 0.1 });
  this->Scene.Renderer->SetBackground(0.8, 0.4, 0.0);
  this->Scene.Pass->SetEstimator(vtkPenumbraLightShaftPass::RADIAL);
  const std::vector<double> white = this->Scene.RenderWithPass();
  this->Scene.Pass->GetConstants().Sky = penumbra::ShaftSkies::Image;
  const std::vector<double> red = this->Scene.RenderWithPass();
  vtkNew<vtkImageData> image;
  this->Scene.Pass->CopyShafts(image);
  vtkDataArray* light = image->GetPointData()->GetArray("LightShafts");
  for (std::size_t i = 0; i < red.size(); ++i)
  {
    const auto at = static_cast<vtkIdType>(i);
    EXPECT_NEAR(red[i], 0.8 * white[i], 1e-3 * white[i]);
    EXPECT_NEAR(light->GetComponent(at, 1), 0.5 * red[i], 3e-3 * red[i]);
    EXPECT_EQ(light->GetComponent(at, 2), 0.0);
  }
}

TEST_F(LightShaftPass, LetsSelectedActorsEmitWhereVisible)
{
  // A green plate, half of it behind a black box.
  ShaftScene scene(96, 72);
  scene.AddBox({ 1.5, 0.0, 2.0 }, { 3.0, 0.5, 4.0 });
  const vtkSmartPointer<vtkActor> plate = scene.AddBox({ 0.0, 2.0, 2.0 }, { 4.0, 0.5, 2.0 });
  plate->GetProperty()->SetColor(0.0, 1.0, 0.0);
  scene.Look({ 0.0, -11.0, 2.0 }, { 0.0, 0.0, 2.0 });
  scene.AddSun({ 0.0, 1.0, 0.0 });
  scene.SetMedium(0.12, 0.12);
  scene.Pass->SetEstimator(vtkPenumbraLightShaftPass::RADIAL);
  scene.Pass->GetConstants().PathRatio = 1000.0; // an emitter that is hardly blurred
  scene.Pass->AddEmitter(plate);
  const auto greens = [&scene]() {
    EXPECT_EQ(scene.RenderWithPass()[36 * 96 + 30], 0.0); // no red
    vtkNew<vtkImageData> image;
    scene.Pass->CopyShafts(image);
    vtkDataArray* light = image->GetPointData()->GetArray("LightShafts");
    std::vector<double> green(96 * 72);
    for (std::size_t i = 0; i < green.size(); ++i)
    {
      green[i] = light->GetComponent(static_cast<vtkIdType>(i), 1);
    }
    return green;
  };
  const std::vector<double> masked = greens();
  EXPECT_GT(masked[36 * 96 + 40], 0.5 / WholeSphere); // the plate
  EXPECT_EQ(masked[36 * 96 + 56], 0.0);               // the box in front of it
  EXPECT_EQ(masked[66 * 96 + 40], 0.0);               // the sky
  scene.Pass->GetConstants().Occlusion = penumbra::ShaftOcclusions::Prepass;
  const std::vector<double> drawn = greens();
  EXPECT_LT(RelativeRmse(drawn, masked), 0.02);
}

TEST_F(LightShaftPass, DrawsNoStreaksFromBrightSurfacesUnlessByContrast)
{
  this->Scene.AddSun({ 0.1, 1.0, 0.1 });
  this->Scene.Pass->SetEstimator(vtkPenumbraLightShaftPass::RADIAL);
  const auto paint = [this](bool white) {
    vtkActorCollection* actors = this->Scene.Renderer->GetActors();
    for (int i = 0; i < actors->GetNumberOfItems(); ++i)
    {
      const double shade = white && i % 2 == 0 ? 1.0 : 0.0;
      vtkActor::SafeDownCast(actors->GetItemAsObject(i))
        ->GetProperty()
        ->SetColor(shade, shade, shade);
    }
    return this->Scene.RenderWithPass();
  };
  EXPECT_EQ(paint(true), paint(false));
  this->Scene.Pass->GetConstants().Occlusion = penumbra::ShaftOcclusions::Contrast;
  this->Scene.Pass->GetConstants().SurfaceEmission = 0.1;
  const std::vector<double> black = paint(false);
  const std::vector<double> white = paint(true);
  const std::vector<double> left = this->Scene.Transmittance();
  double maximum = 0.0;
  for (std::size_t i = 0; i < black.size(); ++i)
  {
    maximum = std::max(maximum, (white[i] - black[i]) / ((1.0 - left[i]) / WholeSphere));
  }
  EXPECT_GT(maximum, 0.01);
  EXPECT_LT(maximum, 0.101);
}

TEST_F(LightShaftPass, AddsNoMoreLightToAForegroundThanItsAirScatters)
{
  // A box one unit in front of the camera fills half of the image. The light and all lit air are
  // far behind it.
  this->Scene.AddBox({ 1.7, -8.5, 2.5 }, { 2.0, 3.0, 6.0 });
  this->Scene.AddSun({ 0.1, 1.0, 0.1 });
  for (const int estimator : { vtkPenumbraLightShaftPass::DEPTH, vtkPenumbraLightShaftPass::RADIAL,
         vtkPenumbraLightShaftPass::SHADOW_MAP })
  {
    this->Scene.Pass->SetEstimator(estimator);
    const std::vector<double> light = this->Scene.RenderWithPass();
    const std::vector<double> left = this->Scene.Transmittance();
    for (std::size_t i = 0; i < light.size(); ++i)
    {
      ASSERT_LE(light[i], (1.0 - left[i]) / WholeSphere + 1e-6) << estimator;
    }
    EXPECT_LT(light[36 * 96 + 90], 0.15 / WholeSphere);
  }
}

TEST_F(LightShaftPass, ChangesContinuouslyWhenALightCrossesTheCameraPlane)
{
  const vtkSmartPointer<vtkLight> sun = this->Scene.AddSun({ 0.0, 1.0, 0.2 });
  for (const int estimator : { vtkPenumbraLightShaftPass::DEPTH, vtkPenumbraLightShaftPass::RADIAL,
         vtkPenumbraLightShaftPass::SHADOW_MAP })
  {
    this->Scene.Pass->SetEstimator(estimator);
    std::vector<double> before;
    for (int angle = 84; angle <= 96; ++angle)
    {
      const double a = angle * 0.017453292519943295;
      sun->SetPosition(std::sin(a), std::cos(a), 0.2);
      const std::vector<double> now = this->Scene.RenderWithPass();
      for (std::size_t i = 0; i < before.size(); ++i)
      {
        ASSERT_LE(std::abs(now[i] - before[i]), 3.0 / 255.0) << estimator << " " << angle;
      }
      before = now;
    }
  }
}

TEST_F(LightShaftPass, AdaptsItsToneAndKeepsItStable)
{
  const vtkSmartPointer<vtkLight> sun = this->Scene.AddSun({ 0.2, 1.0, 0.32 });
  const auto largest = [this]() {
    const std::vector<double> light = this->Scene.RenderWithPass();
    return *std::max_element(light.begin(), light.end());
  };
  sun->SetIntensity(100.0);
  EXPECT_GT(largest(), 2.0); // white is 1
  this->Scene.Pass->AutomaticToneOn();
  // The image behind is black.
  EXPECT_NEAR(largest(), 1.0, 1e-3);
  const double gain = this->Statistic("Light/Gain");
  EXPECT_NEAR(largest(), 1.0, 1e-3);
  EXPECT_EQ(this->Statistic("Light/Gain"), gain);
  // The gain does not compensate a flash of four times the light at once.
  sun->SetIntensity(400.0);
  EXPECT_NEAR(largest(), std::pow(4.0, 0.9), 0.05);
  sun->SetIntensity(0.01);
  EXPECT_GT(largest(), 0.0);
  this->Scene.Pass->AutomaticToneOff();
  EXPECT_LT(largest(), 0.001);
}

TEST_F(LightShaftPass, AppliesAfterAmbientOcclusionInEitherOrder)
{
  this->Scene.Renderer->SetBackground(0.5, 0.5, 0.5);
  this->Scene.AddSun({ 0.2, 1.0, 0.32 });
  const std::vector<double> before = this->Scene.RenderWithPass();
  vtkPenumbraLightShaftPass::RemoveFrom(this->Scene.Renderer);
  vtkPenumbraTemporalSSAOPass::AddTo(this->Scene.Renderer);
  this->Scene.Pass = vtkPenumbraLightShaftPass::AddTo(this->Scene.Renderer);
  this->Scene.SetMedium(0.12, 0.12);
  const std::vector<double> after = this->Scene.RenderWithPass();
  const std::vector<unsigned char> one = this->Image();
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    EXPECT_NEAR(after[i], before[i], 1e-3);
  }
  vtkPenumbraTemporalSSAOPass::RemoveFrom(this->Scene.Renderer);
  EXPECT_EQ(vtkPenumbraLightShaftPass::AddTo(this->Scene.Renderer), this->Scene.Pass);
  vtkPenumbraTemporalSSAOPass::AddTo(this->Scene.Renderer);
  EXPECT_EQ(this->Image(), one);
  vtkPenumbraLightShaftPass::RemoveFrom(this->Scene.Renderer);
  EXPECT_NE(this->Scene.Renderer->GetPass(), nullptr);
  vtkPenumbraTemporalSSAOPass::RemoveFrom(this->Scene.Renderer);
  EXPECT_EQ(this->Scene.Renderer->GetPass(), nullptr);
}

TEST_F(LightShaftPass, IncludesAnOccluderInTheMargin)
{
  // At the ball, half of the width of the image is 5.9 world units. The margin is a fifth of the
  // width.
  this->Scene.Renderer->RemoveAllViewProps();
  this->Scene.AddFloor(12.0);
  const vtkSmartPointer<vtkActor> ball = this->Scene.AddSphere({ 7.0, 0.0, 2.0 }, 0.8);
  this->Scene.AddSun({ 0.6, 1.0, 0.2 });
  const std::vector<double> reference = this->Scene.RenderWithRayCaster(64);
  const double error = RelativeRmse(this->Scene.RenderWithPass(), reference);
  ball->VisibilityOff();
  EXPECT_LT(error, 0.7 * RelativeRmse(this->Scene.RenderWithPass(), reference));
}
