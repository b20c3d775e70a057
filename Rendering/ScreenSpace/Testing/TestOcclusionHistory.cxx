// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Which changes keep or discard the temporal history of occlusion, and which values it may contain.
#include "OcclusionScene.h"
#include "vtkPenumbraOcclusionConstants.h"

#include "vtkPenumbraBilateralFilterPass.h"
#include "vtkPenumbraKernelEstimator.h"
#include "vtkPenumbraLightShaftPass.h"
#include "vtkPenumbraOcclusionEstimator.h"
#include "vtkPenumbraShaftConstants.h"

#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkTextureObject.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

namespace
{

using Pass = vtkPenumbraTemporalSSAOPass;

double Statistic(OcclusionScene& scene, const char* name)
{
  return scene.Pass->GetStatistics()->GetArray(name)->GetComponent(0, 0);
}

void RenderFrames(OcclusionScene& scene, int frames, double azimuth = 0.0)
{
  for (int frame = 0; frame < frames; ++frame)
  {
    scene.Renderer->GetActiveCamera()->Azimuth(azimuth);
    scene.Window->Render();
  }
}

void BuildSphereOnFloor(OcclusionScene& scene)
{
  scene.AddWall({ -3, -3, 0 }, { 6, 0, 0 }, { 0, 6, 0 });
  scene.AddSphere({ 0, 0, 0.5 }, 0.5);
  scene.SetCamera({ 0, -5, 3 }, { 0, 0, 0.4 });
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(Pass::NEVER);
  scene.Pass->SetKernelName("march");
}

/// Estimator that returns the same value in every pixel, or NaN if ReturnsNaN is true.
class ConstantEstimator : public vtkPenumbraOcclusionEstimator
{
public:
  static ConstantEstimator* New();
  vtkTypeMacro(ConstantEstimator, vtkPenumbraOcclusionEstimator);

  int Estimate(const Request& request, vtkTextureObject* target) override
  {
    const float value = this->ReturnsNaN ? std::numeric_limits<float>::quiet_NaN() : 0.5f;
    std::vector<float> values(
      static_cast<std::size_t>(target->GetWidth()) * target->GetHeight(), value);
    target->Create2DFromRaw(target->GetWidth(), target->GetHeight(), 1, VTK_FLOAT, values.data());
    return request.Samples;
  }
  void ReleaseGraphicsResources(vtkWindow*) override {}

  bool ReturnsNaN = false;
};
vtkStandardNewMacro(ConstantEstimator);

TEST(OcclusionHistory, IsBoundedForMoreSamplesThanMaximumWeight)
{
  OcclusionScene scene;
  BuildSphereOnFloor(scene);
  scene.Pass->GetConstants().Filter = false;
  scene.Pass->GetConstants().FirstSamples = 32;
  scene.Pass->GetConstants().Samples = 32;
  scene.Pass->GetConstants().MaximumWeight = 8.0;
  RenderFrames(scene, 12, 0.25);
  const std::vector<float> moving = scene.Array("AmbientOcclusion");
  EXPECT_GE(*std::min_element(moving.begin(), moving.end()), 0.f);
  scene.Pass->SetConvergeInOneRender(Pass::ALWAYS);
  scene.Window->Render();
  EXPECT_LT(Rms(moving, scene.Array("AmbientOcclusion")), 0.1);
}

TEST(OcclusionHistory, HoldsFiniteValuesOnly)
{
  for (const double azimuth : { 0.0, 0.25 })
  {
    OcclusionScene scene;
    BuildSphereOnFloor(scene);
    vtkNew<ConstantEstimator> estimator;
    scene.Pass->SetEstimator(estimator);
    RenderFrames(scene, 3, azimuth);
    estimator->ReturnsNaN = true;
    RenderFrames(scene, 2, azimuth);
    estimator->ReturnsNaN = false;
    RenderFrames(scene, 2, azimuth);
    const std::vector<float> depths = scene.Array("Depth");
    const std::vector<float> values = scene.Array("AmbientOcclusion");
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      ASSERT_NEAR(values[i], std::isfinite(depths[i]) ? 0.5f : 0.f, 1e-3f) << azimuth;
    }
  }
}

TEST(OcclusionHistory, DiscardsOcclusionOfRemovedProps)
{
  const auto draw = [](const std::function<void(OcclusionScene&, vtkActor*)>& disappear) {
    OcclusionScene scene;
    scene.AddWall({ -3, -3, 0 }, { 6, 0, 0 }, { 0, 6, 0 });
    const auto oldest = scene.AddSphere({ -0.7, 0, 0.5 }, 0.5);
    scene.AddSphere({ 0.9, 0, 0.5 }, 0.5);
    scene.SetCamera({ 0, -5, 3 }, { 0, 0, 0.4 });
    scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(Pass::NEVER);
    scene.Pass->SetKernelName("march");
    RenderFrames(scene, 40, 0.25);
    disappear(scene, oldest);
    RenderFrames(scene, 3, 0.25);
    const std::vector<float> afterThreeFrames = scene.Array("AmbientOcclusion");
    scene.Pass->SetConvergeInOneRender(Pass::ALWAYS);
    scene.Window->Render();
    const std::vector<float> reference = scene.Array("AmbientOcclusion");
    int wrong = 0;
    for (std::size_t i = 0; i < afterThreeFrames.size(); ++i)
    {
      wrong += std::abs(afterThreeFrames[i] - reference[i]) > 0.1f;
    }
    return std::make_pair(wrong, Rms(afterThreeFrames, reference));
  };
  const auto kept = draw([](OcclusionScene&, vtkActor*) {});
  const auto hidden = draw([](OcclusionScene&, vtkActor* actor) { actor->VisibilityOff(); });
  const auto removed =
    draw([](OcclusionScene& scene, vtkActor* actor) { scene.Renderer->RemoveActor(actor); });
  RecordProperty("kept", kept.first);
  RecordProperty("hidden", hidden.first);
  for (const auto& result : { hidden, removed })
  {
    EXPECT_LT(result.first, 160 * 120 / 100) << "pixels off by more than 0.1; kept: " << kept.first;
    EXPECT_LT(result.second, 0.04) << "kept: " << kept.second;
  }
}

TEST(OcclusionHistory, KeepsSamplesIfASettingDoesNotAffectOcclusion)
{
  OcclusionScene scene;
  BuildSphereOnFloor(scene);
  RenderFrames(scene, 20, 0.25);
  const std::function<void(Pass*)> changes[] = { [](Pass* pass) { pass->SetStrength(0.5); },
    [](Pass* pass) { pass->SetLightAwareness(0.5); },
    [](Pass* pass) { pass->GetConstants().Filter = false; },
    [](Pass* pass) { pass->SetTolerance(0.005); }, [](Pass* pass) { pass->SetTolerance(0.02); },
    [](Pass* pass) { pass->GetConstants().Samples = 16; }, [](Pass* pass) { pass->Modified(); } };
  int number = 0;
  for (const auto& change : changes)
  {
    for (const double azimuth : { 0.25, 0.0, 0.0 })
    {
      if (azimuth == 0.0)
      {
        RenderFrames(scene, 3);
      }
      const double staticSamples = Statistic(scene, "Samples/Static");
      change(scene.Pass);
      RenderFrames(scene, 1, azimuth);
      EXPECT_GT(Statistic(scene, "Pixels/Reprojected"), azimuth == 0.0 ? 0.999 : 0.9) << number;
      if (azimuth == 0.0)
      {
        EXPECT_GE(Statistic(scene, "Samples/Static"), staticSamples) << number;
      }
    }
    ++number;
  }
  scene.Pass->SetRadius(0.5);
  RenderFrames(scene, 1);
  EXPECT_EQ(Statistic(scene, "Pixels/Reprojected"), 0.0);
}

TEST(OcclusionHistory, KeepsASmallWeightIfTheEstimatorChanges)
{
  for (const double azimuth : { 0.0, 0.25 })
  {
    OcclusionScene scene;
    BuildSphereOnFloor(scene);
    RenderFrames(scene, 20, azimuth);
    const std::vector<float> before = scene.Array("AmbientOcclusion");
    scene.Pass->SetKernelName("horizon");
    RenderFrames(scene, 1);
    // The first frame shows little more noise than the last one.
    EXPECT_LT(Rms(before, scene.Array("AmbientOcclusion")), 0.03) << azimuth;
    const double weight =
      scene.Pass->GetConstants().MaximumWeight * scene.At("Convergence", { 1, -1, 0 });
    EXPECT_NEAR(weight,
      scene.Pass->GetConstants().InvalidationWeight + scene.Pass->GetConstants().FirstSamples, 1.0);
    for (int frame = 0; frame < 300 && !scene.Pass->IsConverged(); ++frame)
    {
      scene.Window->Render();
    }
    EXPECT_TRUE(scene.Pass->IsConverged());
    const std::vector<float> converged = scene.Array("AmbientOcclusion");
    scene.Pass->SetConvergeInOneRender(Pass::ALWAYS);
    scene.Pass->SetTolerance(0.003);
    RenderFrames(scene, 1);
    EXPECT_LT(Rms(converged, scene.Array("AmbientOcclusion")), 0.01) << azimuth;
  }
}

TEST(OcclusionHistory, TakesMoreSamplesWhereItIsShort)
{
  OcclusionScene scene;
  BuildSphereOnFloor(scene);
  RenderFrames(scene, 40, 0.25);
  const int frames = 3;
  RenderFrames(scene, frames, 2.0);
  const std::vector<float> convergences = scene.Array("Convergence");
  const double disoccluded =
    scene.Pass->GetConstants().FirstSamples / scene.Pass->GetConstants().MaximumWeight;
  int shortPixels = 0;
  int fullPixels = 0;
  for (const float convergence : convergences)
  {
    EXPECT_GT(convergence, 0.99 * disoccluded);
    shortPixels += convergence < frames * 1.01 * disoccluded;
    fullPixels += convergence > 0.5;
  }
  EXPECT_GT(shortPixels, 50);
  EXPECT_GT(fullPixels, 2000);
  EXPECT_EQ(Statistic(scene, "Samples/PerPixel"), scene.Pass->GetConstants().Samples);
}

TEST(OcclusionHistory, TakesTurnsWhereItIsSettled)
{
  OcclusionScene scene;
  BuildSphereOnFloor(scene);
  const int turns = 4;
  scene.Pass->GetConstants().SettledPeriod = turns;
  RenderFrames(scene, 1);
  RenderFrames(scene, 40, 1e-6);
  const double weight = scene.Pass->GetConstants().MaximumWeight;
  const std::vector<float> before = scene.Array("Convergence");
  const std::vector<float> depths = scene.Array("Depth");
  for (int turn = 1; turn <= turns; ++turn)
  {
    RenderFrames(scene, 1, 1e-6);
    const std::vector<float> after = scene.Array("Convergence");
    int pixels = 0;
    int withSamples = 0;
    for (std::size_t i = 0; i < after.size(); ++i)
    {
      pixels += std::isfinite(depths[i]);
      // A quarter of a sample for the interpolation of weights between blocks.
      withSamples += (after[i] - before[i]) * weight > scene.Pass->GetConstants().Samples - 0.25;
    }
    // In each period, each pixel gets samples once.
    EXPECT_GT(withSamples, (static_cast<double>(turn) / turns - 0.02) * pixels) << turn;
    EXPECT_LT(withSamples, (static_cast<double>(turn) / turns + 0.02) * pixels) << turn;
  }
}

TEST(OcclusionHistory, IsDiscardedAtACut)
{
  const auto draw = [](int framesBefore) {
    OcclusionScene scene;
    BuildSphereOnFloor(scene);
    RenderFrames(scene, framesBefore, 0.25);
    scene.SetCamera({ 4, 3, 2 }, { 0, 0, 0.4 });
    scene.Window->Render();
    return scene.Array("AmbientOcclusion");
  };
  EXPECT_EQ(draw(40), draw(0));
}

TEST(OcclusionHistory, IsDiscardedInFastTurns)
{
  // Turns by 10 degrees from views of the narrow and of the wide side of a box, whose width determines the
  // thickness of occluders.
  const auto draw = [](double degreesPerFrame) {
    OcclusionScene scene;
    BuildSphereOnFloor(scene);
    scene.AddWall({ 0.9, 0.5, 0 }, { 0.05, 0, 0 }, { 0, 0, 1.5 });
    scene.AddWall({ 0.9, -0.5, 0 }, { 0.05, 0, 0 }, { 0, 0, 1.5 });
    scene.AddWall({ 0.9, -0.5, 0 }, { 0, 1, 0 }, { 0, 0, 1.5 });
    scene.AddWall({ 0.95, -0.5, 0 }, { 0, 1, 0 }, { 0, 0, 1.5 });
    for (int frame = 5; frame >= 0; --frame)
    {
      const double angle = vtkMath::RadiansFromDegrees(40.0 - frame * degreesPerFrame);
      scene.SetCamera({ 5 * std::sin(angle), -5 * std::cos(angle), 3 }, { 0, 0, 0.4 });
      scene.Window->Render();
    }
    return scene.Array("AmbientOcclusion");
  };
  EXPECT_EQ(draw(10.0), draw(-10.0));
}

TEST(OcclusionHistory, RefinesToASmallerTolerance)
{
  OcclusionScene scene;
  BuildSphereOnFloor(scene);
  scene.Pass->SetTolerance(0.03);
  for (int frame = 0; frame < 300 && !scene.Pass->IsConverged(); ++frame)
  {
    scene.Window->Render();
  }
  ASSERT_TRUE(scene.Pass->IsConverged());
  const double coarse = Statistic(scene, "Samples/Static");
  scene.Pass->SetTolerance(0.008);
  scene.Window->Render();
  EXPECT_FALSE(scene.Pass->IsConverged());
  EXPECT_GT(Statistic(scene, "Samples/Static"), coarse);
  for (int frame = 0; frame < 600 && !scene.Pass->IsConverged(); ++frame)
  {
    scene.Window->Render();
  }
  ASSERT_TRUE(scene.Pass->IsConverged());
  EXPECT_LE(scene.Pass->GetEstimatedError(), 0.008);
  const std::vector<float> refined = scene.Array("AmbientOcclusion");
  scene.Pass->SetConvergeInOneRender(Pass::ALWAYS);
  scene.Pass->SetTolerance(0.003);
  scene.Window->Render();
  EXPECT_LT(Rms(refined, scene.Array("AmbientOcclusion")), 0.008);
}

TEST(OcclusionHistory, AppliesStrengthToAConvergedImage)
{
  OcclusionScene scene;
  BuildSphereOnFloor(scene);
  scene.Pass->SetConvergeInOneRender(Pass::ALWAYS);
  scene.Pass->SetTolerance(0.03);
  RenderFrames(scene, 2);
  scene.Pass->SetStrength(0.25);
  RenderFrames(scene, 1);
  EXPECT_EQ(Statistic(scene, "Samples/PerPixel"), 0.0);
  const std::vector<int> image = scene.Image();
  const std::vector<float> occlusion = scene.Array("AmbientOcclusion");
  const std::vector<float> depth = scene.Array("Depth");
  for (std::size_t i = 0; i < occlusion.size(); ++i)
  {
    if (std::isfinite(depth[i])) // an unlit white surface
    {
      ASSERT_NEAR(image[4 * i], 255.f * (1.f - 0.25f * occlusion[i]), 1.5f);
    }
  }
}

TEST(OcclusionHistory, IsReprojectedDuringZoom)
{
  for (const double factor : { 1.03, 1.0 / 1.03 })
  {
    OcclusionScene scene;
    BuildSphereOnFloor(scene);
    scene.Renderer->ResetCamera();
    RenderFrames(scene, 20);
    double minimum = 1.0;
    for (int frame = 0; frame < 28; ++frame)
    {
      scene.Renderer->GetActiveCamera()->Dolly(factor);
      scene.Renderer->ResetCameraClippingRange();
      scene.Window->Render();
      minimum = std::min(minimum, Statistic(scene, "Pixels/Reprojected"));
    }
    EXPECT_GE(minimum, 0.9) << factor;
    const std::vector<float> zoomed = scene.Array("AmbientOcclusion");
    scene.Pass->SetConvergeInOneRender(Pass::ALWAYS);
    scene.Window->Render();
    EXPECT_LT(Rms(zoomed, scene.Array("AmbientOcclusion")), 0.04) << factor;
  }
}

TEST(PassSetters, RejectNaN)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  vtkObject::GlobalWarningDisplayOff();
  vtkNew<Pass> occlusion;
  vtkNew<vtkPenumbraLightShaftPass> shafts;
  vtkNew<vtkPenumbraBilateralFilterPass> filter;
  vtkNew<vtkPenumbraKernelEstimator> kernel;
#define EXPECT_REJECTED(object, name)                                                              \
  {                                                                                                \
    const double before = (object)->Get##name();                                                   \
    const vtkMTimeType time = (object)->GetMTime();                                                \
    (object)->Set##name(nan);                                                                      \
    EXPECT_EQ((object)->Get##name(), before) << #name;                                             \
    EXPECT_EQ((object)->GetMTime(), time) << #name;                                                \
  }
  EXPECT_REJECTED(occlusion, Tolerance)
  EXPECT_REJECTED(occlusion, Radius)
  EXPECT_REJECTED(occlusion, Strength)
  EXPECT_REJECTED(occlusion, LightAwareness)
  EXPECT_REJECTED(shafts, Tolerance)
  EXPECT_REJECTED(shafts, Exposure)
  EXPECT_REJECTED(shafts, Thickness)
  EXPECT_REJECTED(filter, DistanceSigma)
  EXPECT_REJECTED(kernel, Thickness)
#undef EXPECT_REJECTED
  vtkObject::GlobalWarningDisplayOn();
  occlusion->SetStrength(2.0);
  EXPECT_EQ(occlusion->GetStrength(), 1.0);
}

TEST(PassGetters, ReturnEmptyResultsWithoutAWindow)
{
  vtkObject::GlobalWarningDisplayOff();
  for (const bool finalized : { true, false })
  {
    auto scene = std::make_unique<OcclusionScene>();
    BuildSphereOnFloor(*scene);
    vtkNew<vtkLight> light;
    light->SetPosition(3, 1, 4);
    scene->Renderer->AddLight(light);
    const vtkSmartPointer<Pass> occlusion = scene->Pass;
    const vtkSmartPointer<vtkPenumbraLightShaftPass> shafts =
      vtkPenumbraLightShaftPass::AddTo(scene->Renderer);
    const vtkSmartPointer<vtkRenderPass> chain = scene->Renderer->GetPass();
    scene->Window->Render();
    scene->Renderer->SetPass(nullptr); // Applications do this before they delete a window.
    if (finalized)
    {
      scene->Window->Finalize();
    }
    else
    {
      scene.reset();
    }
    EXPECT_EQ(occlusion->GetStatistics()->GetNumberOfArrays(), 0);
    EXPECT_EQ(shafts->GetStatistics()->GetNumberOfArrays(), 0);
    vtkNew<vtkImageData> image;
    occlusion->CopyOcclusion(image);
    EXPECT_EQ(image->GetNumberOfPoints(), 0);
    shafts->CopyShafts(image);
    EXPECT_EQ(image->GetNumberOfPoints(), 0);
    EXPECT_FALSE(occlusion->IsConverged());
    EXPECT_EQ(occlusion->GetEstimatedError(), VTK_DOUBLE_MAX);
    EXPECT_STREQ(occlusion->GetActiveKernelName(), "march");
  }
  vtkObject::GlobalWarningDisplayOn();
}

TEST(PassGetters, WorkInANewWindow)
{
  // A pass outlives its first window and renders into a second one.
  auto first = std::make_unique<OcclusionScene>();
  BuildSphereOnFloor(*first);
  const vtkSmartPointer<Pass> pass = first->Pass;
  const vtkSmartPointer<vtkRenderPass> chain = first->Renderer->GetPass();
  first->Window->Render();
  first->Renderer->SetPass(nullptr);
  first.reset();
  OcclusionScene second;
  BuildSphereOnFloor(second);
  second.Renderer->SetPass(chain);
  second.Pass = pass;
  second.Window->Render();
  EXPECT_EQ(Statistic(second, "Samples/PerPixel"), 32.0);
  EXPECT_EQ(second.Array("AmbientOcclusion").size(), 160u * 120u);
}

}
