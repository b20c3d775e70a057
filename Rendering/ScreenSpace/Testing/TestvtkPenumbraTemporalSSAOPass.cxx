// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionScene.h"

#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkProperty.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

double Statistic(vtkPenumbraTemporalSSAOPass* pass, const char* name)
{
  return pass->GetStatistics()->GetArray(name)->GetComponent(0, 0);
}

TEST(TemporalSSAOPass, IgnoresNullRenderers)
{
  vtkObject::GlobalWarningDisplayOff();
  EXPECT_EQ(vtkPenumbraTemporalSSAOPass::AddTo(nullptr), nullptr);
  vtkPenumbraTemporalSSAOPass::RemoveFrom(nullptr);
  EXPECT_EQ(vtkPenumbraTemporalSSAOPass::FindIn(nullptr), nullptr);
  vtkObject::GlobalWarningDisplayOn();
}

TEST(TemporalSSAOPass, ReturnsZeroOnAnOpenPlane)
{
  OcclusionScene scene;
  scene.AddFloor();
  scene.SetCamera({ 0, -4, 2 }, { 0, 0, 0 });
  scene.AddOcclusionPass(1.0);
  scene.Window->Render();
  const std::vector<float> occlusion = scene.Array("AmbientOcclusion");
  ASSERT_EQ(occlusion.size(), 160u * 120u);
  // At the shared edge of the floor's two triangles, depth is off by the rounding of the depth
  // buffer.
  const auto dark =
    std::count_if(occlusion.begin(), occlusion.end(), [](float value) { return value > 1e-3f; });
  EXPECT_LE(dark, 200);
  EXPECT_LT(*std::max_element(occlusion.begin(), occlusion.end()), 0.05f);
}

TEST(TemporalSSAOPass, ReturnsDepthAlongTheViewAxis)
{
  OcclusionScene scene;
  scene.AddWall({ -5, 3, -5 }, { 10, 0, 0 }, { 0, 0, 10 });
  scene.SetCamera({ 0, -4, 0 }, { 0, 0, 0 });
  scene.AddOcclusionPass(1.0);
  scene.Window->Render();
  for (const float depth : scene.Array("Depth"))
  {
    EXPECT_NEAR(depth, 7.f, 1e-4f);
  }
}

TEST(TemporalSSAOPass, MatchesTheClosedFormInFrontOfAWall)
{
  OcclusionScene scene;
  scene.AddOcclusionPass(1.0);
  const std::vector<double> errors = ErrorsBeforeAWall(scene);
  for (std::size_t row = 0; row < errors.size(); ++row)
  {
    EXPECT_NEAR(errors[row], 0.0, 0.06) << "in row " << row;
  }
  EXPECT_LT(RootMeanSquare(errors), 0.025);
}

TEST(TemporalSSAOPass, TakesNoSamplesOnceConverged)
{
  OcclusionScene scene;
  scene.AddFloor();
  scene.AddSphere({ 0, 0, 0.5 }, 0.5);
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0 });
  scene.AddOcclusionPass(1.0);
  scene.Window->Render();
  EXPECT_TRUE(scene.Pass->IsConverged());
  EXPECT_LE(scene.Pass->GetEstimatedError(), scene.Pass->GetTolerance());
  const std::vector<int> first = scene.Image();
  for (int i = 0; i < 3; ++i)
  {
    scene.Window->Render();
    EXPECT_EQ(scene.Image(), first);
    EXPECT_EQ(Statistic(scene.Pass, "Samples/PerPixel"), 0.0);
  }
  scene.SetCamera({ 0.1, -4, 3 }, { 0, 0, 0 });
  scene.Window->Render();
  EXPECT_GT(Statistic(scene.Pass, "Samples/PerPixel"), 0.0);
}

TEST(TemporalSSAOPass, DiscardsHistoryBeforeConvergingInOneRender)
{
  // The image equals that of a scene without history, within the tolerance.
  const auto render = [](bool moved) {
    OcclusionScene scene;
    scene.AddWall({ -3, -3, 0 }, { 6, 0, 0 }, { 0, 6, 0 });
    const auto sphere = scene.AddSphere({ moved ? -0.5 : 0.5, 0, 0.5 }, 0.5);
    scene.SetCamera({ 0, -5, 3 }, { 0, 0, 0.4 });
    scene.AddOcclusionPass(1.0)->SetTolerance(0.003);
    for (int frame = 0; moved && frame < 3; ++frame)
    {
      scene.Window->Render();
    }
    sphere->SetPosition(0.5, 0, 0.5);
    scene.Window->Render();
    EXPECT_TRUE(scene.Pass->IsConverged());
    return scene.Array("AmbientOcclusion");
  };
  EXPECT_LT(Rms(render(true), render(false)), 0.003);
}

TEST(TemporalSSAOPass, DoesNotConvergeToStaleSamples)
{
  OcclusionScene scene;
  scene.AddWall({ -3, -3, 0 }, { 6, 0, 0 }, { 0, 6, 0 });
  const auto sphere = scene.AddSphere({ -0.5, 0, 0.5 }, 0.5);
  scene.SetCamera({ 0, -5, 3 }, { 0, 0, 0.4 });
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
  for (int frame = 0; frame < 20; ++frame)
  {
    scene.Window->Render();
  }
  sphere->SetPosition(0.5, 0, 0.5);
  for (int frame = 0; frame < 600 && (frame < 2 || !scene.Pass->IsConverged()); ++frame)
  {
    scene.Window->Render();
  }
  ASSERT_TRUE(scene.Pass->IsConverged());
  const std::vector<float> refined = scene.Array("AmbientOcclusion");
  scene.Pass->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::ALWAYS);
  scene.Pass->SetTolerance(0.002); // Discards the history.
  scene.Window->Render();
  EXPECT_LT(Rms(refined, scene.Array("AmbientOcclusion")), 0.01);
}

TEST(TemporalSSAOPass, UpdatesColorsWithoutNewSamples)
{
  // Once converged, the scene is rendered without the pass and multiplied by the stored factor,
  // also in a viewport that covers part of the window.
  OcclusionScene scene;
  scene.AddFloor();
  const auto sphere = scene.AddSphere({ 0, 0, 0.5 }, 0.5);
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0 });
  scene.Renderer->SetViewport(0.25, 0.25, 1, 1);
  scene.AddOcclusionPass(1.0);
  scene.Window->Render();
  ASSERT_TRUE(scene.Pass->IsConverged());
  sphere->GetProperty()->SetColor(0, 0.5, 1);
  scene.Window->Render();
  EXPECT_EQ(Statistic(scene.Pass, "Samples/PerPixel"), 0.0);
  const std::vector<int> occluded = scene.Image();
  const std::vector<float> occlusion = scene.Array("AmbientOcclusion");
  vtkPenumbraTemporalSSAOPass::RemoveFrom(scene.Renderer);
  scene.Window->Render();
  const std::vector<int> plain = scene.Image();
  const int left = 40;
  const int bottom = 30;
  ASSERT_EQ(occlusion.size(), 120u * 90u);
  for (int j = 0; j < 90; ++j)
  {
    for (int i = 0; i < 120; ++i)
    {
      const float open = 1.f - occlusion[j * 120 + i];
      for (int c = 0; c < 3; ++c)
      {
        const int at = 4 * ((j + bottom) * scene.Width + i + left) + c;
        ASSERT_NEAR(occluded[at], open * plain[at], 1.5) << i << ", " << j;
      }
    }
  }
}

TEST(TemporalSSAOPass, RestoresTheImageWhenRemoved)
{
  OcclusionScene scene;
  scene.AddFloor(1.0);
  scene.AddSphere({ 0, 0, 0.5 }, 0.5);
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0 });
  scene.Window->Render();
  const std::vector<int> before = scene.Image();
  scene.AddOcclusionPass(1.0);
  scene.Window->Render();
  EXPECT_NE(scene.Image(), before);
  vtkPenumbraTemporalSSAOPass::RemoveFrom(scene.Renderer);
  EXPECT_EQ(scene.Renderer->GetPass(), nullptr);
  scene.Window->Render();
  EXPECT_EQ(scene.Image(), before);
}

TEST(TemporalSSAOPass, PreservesMultisampledEdges)
{
  // With strength 0 the pass only copies the image: the color of every sample must be preserved,
  // over any background.
  OcclusionScene scene(160, 120, 4);
  scene.Renderer->GradientBackgroundOn();
  scene.Renderer->SetBackground2(0.9, 0.1, 0.5);
  scene.AddSphere({ 0, 0, 0.5 }, 0.7);
  scene.AddWall({ -1, 1, -0.5 }, { 2, 0.1, 0.3 }, { 0, 0.2, 1.5 });
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0 });
  scene.Window->Render();
  ASSERT_GT(scene.Window->GetMultiSamples(), 1);
  const std::vector<int> plain = scene.Image();
  scene.AddOcclusionPass(1.0)->SetStrength(0.0);
  scene.Window->Render();
  const std::vector<int> withPass = scene.Image();
  int largest = 0;
  for (std::size_t i = 0; i < plain.size(); ++i)
  {
    largest = std::max(largest, std::abs(plain[i] - withPass[i]));
  }
  EXPECT_LE(largest, 2);
}

TEST(TemporalSSAOPass, CausesNoHalosWithMultisampling)
{
  // A white sphere far in front of a dark corner: the occlusion of the corner must not darken its
  // silhouette.
  OcclusionScene scene(160, 120, 4);
  scene.AddSphere({ 0, -2, 1.2 }, 0.3);
  scene.AddFloor();
  scene.AddWall({ -20, 0, 0 }, { 40, 0, 0 }, { 0, 0, 20 });
  scene.Renderer->SetBackground(1, 1, 1);
  scene.SetCamera({ 0, -8, 6 }, { 0, 0, 0 });
  scene.AddOcclusionPass(0.5);
  scene.Window->Render();
  const std::array<int, 2> center = scene.Pixel({ 0, -2, 1.2 });
  const std::vector<int> image = scene.Image();
  const std::vector<float> occlusion = scene.Array("AmbientOcclusion");
  // In the row through the center of the sphere, every pixel lies between the brightnesses of both
  // surfaces.
  for (int i = center[0] - 12; i <= center[0] + 12; ++i)
  {
    const std::size_t at = static_cast<std::size_t>(center[1]) * scene.Width + i;
    const float darkest = std::max({ occlusion[at - 1], occlusion[at], occlusion[at + 1] });
    EXPECT_GE(image[4 * at], 255.f * (1.f - darkest) - 2.f) << i - center[0];
  }
}

TEST(TemporalSSAOPass, DarkensBrightColorsLessWithLightAwareness)
{
  OcclusionScene scene;
  const auto floor = scene.AddFloor();
  const auto wall = scene.AddWall({ -20, 0, 0 }, { 40, 0, 0 }, { 0, 0, 20 });
  scene.SetCamera({ 0, -5, 3 }, { 0, 0, 0.2 });
  scene.AddOcclusionPass(1.0)->SetLightAwareness(0.75);
  const std::array<int, 2> foot = scene.Pixel({ 0, -0.05, 0 });
  const std::size_t at = 4 * (static_cast<std::size_t>(foot[1]) * scene.Width + foot[0]);
  for (const double brightness : { 1.0, 0.4 })
  {
    floor->GetProperty()->SetColor(brightness, 0.5 * brightness, 0.0);
    scene.Window->Render();
    const double occlusion = scene.At("AmbientOcclusion", { 0, -0.05, 0 });
    const double factor = 1.0 - occlusion * (1.0 - 0.75 * brightness);
    EXPECT_GT(occlusion, 0.3);
    const std::vector<int> image = scene.Image();
    EXPECT_NEAR(image[at], 255.0 * brightness * factor, 2.0);
    EXPECT_NEAR(image[at + 1], 255.0 * 0.5 * brightness * factor, 2.0);
    EXPECT_EQ(image[at + 2], 0);
  }
}

TEST(TemporalSSAOPass, RendersThePlainSceneWithRadiusZero)
{
  OcclusionScene scene;
  scene.AddFloor(1.0);
  scene.AddSphere({ 0, 0, 0.5 }, 0.5);
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0 });
  scene.Window->Render();
  const std::vector<int> plain = scene.Image();
  scene.AddOcclusionPass(0.0);
  scene.Window->Render();
  EXPECT_EQ(scene.Image(), plain);
  scene.Pass->SetStrength(0.0);
  scene.Pass->SetRadius(1.0);
  scene.Window->Render();
  EXPECT_EQ(scene.Image(), plain);
}

}
