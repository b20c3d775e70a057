// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Every shader of the passes in images of a few hundred pixels, against closed forms and the ray caster.
// Testing/Drivers runs these tests on every driver, also on those that take minutes for larger images.
#include "OcclusionScene.h"
#include "ShaftScene.h"
#include "vtkPenumbraMedium.h"

#include "vtkPenumbraBilateralFilterPass.h"
#include "vtkPenumbraKernels.h"

#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkRenderStepsPass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace
{

using Pass = vtkPenumbraTemporalSSAOPass;

double Statistic(OcclusionScene& scene, const char* name)
{
  return scene.Pass->GetStatistics()->GetArray(name)->GetComponent(0, 0);
}

/// A sphere on a floor; the pass renders one frame at a time.
void BuildMovingScene(OcclusionScene& scene, vtkSmartPointer<vtkActor>& sphere)
{
  scene.AddFloor();
  sphere = scene.AddSphere({ 0, 0, 0.5 }, 0.5);
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0.3 });
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(Pass::NEVER);
  scene.Pass->SetKernelName("horizon");
}

/// Returns the RMSE of the last frame, with the converged occlusion as reference.
double ComputeError(OcclusionScene& scene)
{
  const std::vector<float> moving = scene.Array("AmbientOcclusion");
  scene.Pass->SetConvergeInOneRender(Pass::ALWAYS);
  scene.Pass->SetTolerance(0.02);
  scene.Window->Render();
  return Rms(moving, scene.Array("AmbientOcclusion"));
}

TEST(SmallImages, OcclusionMatchesTheClosedFormInFrontOfAWall)
{
  for (int kernel = 0; kernel < vtkPenumbraKernels::GetNumberOfKernels(); ++kernel)
  {
    const std::string name = vtkPenumbraKernels::GetName(kernel);
    const bool fades = name == "volumetric";
    // Two kernels estimate no closed form: TestvtkPenumbraKernels has their bounds.
    const bool isExact = fades || name == "horizon" || name == "march";
    OcclusionScene scene(32, 24);
    scene.AddOcclusionPass(1.0)->SetKernelName(name.c_str());
    scene.Pass->SetTolerance(0.02);
    const std::vector<double> errors =
      ErrorsBeforeAWall(scene, fades ? BehindWallFading : BehindWall);
    EXPECT_STREQ(scene.Pass->GetActiveKernelName(), name.c_str());
    EXPECT_LT(RootMeanSquare(errors), isExact ? 0.05 : 0.3) << name;
  }
}

TEST(SmallImages, HistoryFollowsTheCamera)
{
  OcclusionScene scene(32, 24);
  vtkSmartPointer<vtkActor> sphere;
  BuildMovingScene(scene, sphere);
  for (int frame = 0; frame < 10; ++frame)
  {
    scene.Renderer->GetActiveCamera()->Azimuth(0.5);
    scene.Window->Render();
  }
  EXPECT_GT(Statistic(scene, "Pixels/Reprojected"), 0.9);
  EXPECT_LT(ComputeError(scene), 0.08);
}

TEST(SmallImages, HistoryFollowsActors)
{
  OcclusionScene scene(32, 24);
  vtkSmartPointer<vtkActor> sphere;
  BuildMovingScene(scene, sphere);
  for (int frame = 0; frame < 6; ++frame)
  {
    scene.Window->Render();
  }
  for (int frame = 0; frame < 4; ++frame)
  {
    sphere->AddPosition(0.05, 0.0, 0.0);
    scene.Window->Render();
  }
  EXPECT_GT(Statistic(scene, "Pixels/ActorMotion"), 0.02);
  EXPECT_LT(ComputeError(scene), 0.1);
}

TEST(SmallImages, OcclusionDarkensSamplesOfPixels)
{
  OcclusionScene scene(32, 24, 4);
  AddSphereBeforeWall(scene);
  scene.Window->Render();
  const std::vector<int> plain = scene.Image();
  scene.AddOcclusionPass(1.0)->SetKernelName("horizon");
  scene.Pass->SetTolerance(0.02);
  scene.Pass->SetStrength(1.0);
  scene.Window->Render();
  const std::vector<int> image = scene.Image();
  int darker = 0;
  for (std::size_t i = 0; i < image.size(); i += 4)
  {
    EXPECT_LE(image[i], plain[i] + 2) << i;
    darker += image[i] < plain[i] - 20;
  }
  EXPECT_GT(darker, 100);
}

TEST(SmallImages, BilateralFilterKeepsAnEvenImage)
{
  OcclusionScene scene(32, 24);
  scene.AddFloor();
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0.3 });
  scene.Window->Render();
  const std::vector<int> plain = scene.Image();
  vtkNew<vtkPenumbraBilateralFilterPass> pass;
  vtkNew<vtkRenderStepsPass> steps;
  pass->SetDelegatePass(steps);
  pass->SetRadius(2);
  scene.Renderer->SetPass(pass);
  scene.Window->Render();
  const std::vector<int> filtered = scene.Image();
  ASSERT_EQ(filtered.size(), plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i)
  {
    EXPECT_NEAR(filtered[i], plain[i], 1) << i;
  }
}

/// Solids over a floor in a medium, lit by a directional light from behind or by a positional one among them.
class SmallShafts : public ::testing::Test
{
protected:
  SmallShafts()
    : Scene(48, 36)
  {
    this->Scene.AddFloor(12.0);
    this->Scene.AddSolids(6, 2);
    this->Scene.Look({ 0.5, -11.0, 2.5 }, { 0.0, 0.0, 2.0 });
    this->Scene.SetMedium(0.12, 0.12);
  }

  /// Returns the RMSE of the pass, relative to the ray caster.
  double ComputeError()
  {
    const std::vector<double> light = this->Scene.RenderWithPass();
    const std::vector<double> reference = this->Scene.RenderWithRayCaster(64);
    double squares = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < reference.size(); ++i)
    {
      squares += (light[i] - reference[i]) * (light[i] - reference[i]);
      size += reference[i] * reference[i];
    }
    return std::sqrt(squares / size);
  }

  ShaftScene Scene;
};

TEST_F(SmallShafts, MatchTheRayCasterByDepth)
{
  const vtkSmartPointer<vtkLight> sun = this->Scene.AddSun({ 0.2, 1.0, 0.32 });
  EXPECT_LT(this->ComputeError(), 0.04);
  this->Scene.Renderer->RemoveLight(sun);
  this->Scene.AddLamp({ 1.0, 2.0, 3.0 });
  EXPECT_LT(this->ComputeError(), 0.12);
}

TEST_F(SmallShafts, MatchTheRayCasterByShadowMaps)
{
  this->Scene.Pass->SetEstimatorToShadowMap();
  this->Scene.AddSun({ 0.2, 1.0, 0.32 });
  EXPECT_LT(this->ComputeError(), 0.04);
}

TEST_F(SmallShafts, MatchTheRayCasterInABox)
{
  this->Scene.Pass->GetMedium()->SetBounds(-3.0, 3.0, -3.0, 3.0, 0.0, 4.0);
  this->Scene.AddSun({ 0.2, 1.0, 0.32 });
  EXPECT_LT(this->ComputeError(), 0.1);
}

TEST_F(SmallShafts, AreFiniteByRadialBlurAndInColoredMedia)
{
  this->Scene.AddSun({ 0.2, 1.0, 0.32 });
  this->Scene.Pass->SetEstimatorToRadial();
  for (const bool colored : { false, true })
  {
    this->Scene.Pass->GetMedium()->SetRayleighScattering(colored ? 0.05 : 0.0);
    this->Scene.Pass->SetAutomaticTone(colored);
    double sum = 0.0;
    for (const double light : this->Scene.RenderWithPass())
    {
      ASSERT_TRUE(light >= 0.0 && light < 100.0);
      sum += light;
    }
    EXPECT_GT(sum, 0.0);
  }
}

}
