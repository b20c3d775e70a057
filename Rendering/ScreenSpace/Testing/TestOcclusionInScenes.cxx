// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The occlusion pass with various cameras and scenes.
#include "OcclusionScene.h"
#include "vtkPenumbraOcclusionConstants.h"

#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkProperty.h"
#include "vtkTextureObject.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace
{

/// Returns the fraction of pixels that differ by more than `limit`.
double FractionAbove(const std::vector<int>& a, const std::vector<int>& b, int limit)
{
  int count = 0;
  for (std::size_t i = 0; i + 3 < a.size() && i + 3 < b.size(); i += 4)
  {
    count += std::abs(a[i] - b[i]) > limit;
  }
  return a.size() == b.size() ? 4.0 * count / static_cast<double>(a.size()) : 1.0;
}

TEST(OcclusionInScenes, IsInvariantUnderScale)
{
  OcclusionScene reference;
  AddSphereBeforeWall(reference);
  reference.AddOcclusionPass(1.0)->SetRadiusUnit(vtkPenumbraTemporalSSAOPass::FRACTION_OF_BOUNDS);
  reference.Pass->SetRadius(0.1);
  reference.Window->Render();
  const std::vector<int> image = reference.Image();
  const std::tuple<double, Vector> cases[] = { { 1e-6, { 0, 0, 0 } }, { 1e6, { 0, 0, 0 } } };
  for (const auto& [unit, at] : cases)
  {
    OcclusionScene scene;
    AddSphereBeforeWall(scene, unit, at);
    vtkPenumbraTemporalSSAOPass::AddTo(scene.Renderer);
    scene.Window->Render();
    EXPECT_LE(FractionAbove(scene.Image(), image, 2), 0.01) << unit;
  }
}

TEST(OcclusionInScenes, IsInvariantUnderTranslation)
{
  // The geometry stays near the origin and is moved by the actor's matrix, so that VTK keeps its
  // precision.
  const auto draw = [](const Vector& at) {
    OcclusionScene scene;
    const auto floor = scene.AddWall({ -3, -3, 0 }, { 6, 0, 0 }, { 0, 4, 0 });
    floor->SetPosition(at[0], at[1], at[2]);
    scene.AddSphere({ at[0], at[1], at[2] + 0.5 }, 0.5);
    scene.SetCamera({ at[0], at[1] - 5, at[2] + 3 }, { at[0], at[1], at[2] + 0.4 });
    scene.AddOcclusionPass(1.0);
    scene.Window->Render();
    return scene.Array("AmbientOcclusion");
  };
  EXPECT_LT(Rms(draw({ 5e5, 5e6, 0 }), draw({ 0, 0, 0 })), 0.01);
}

TEST(OcclusionInScenes, IsIndependentOfTheClippingRange)
{
  const auto draw = [](double nearPlane, double farPlane) {
    OcclusionScene scene;
    AddSphereBeforeWall(scene);
    if (nearPlane > 0.0)
    {
      scene.Renderer->GetActiveCamera()->SetClippingRange(nearPlane, farPlane);
    }
    scene.AddOcclusionPass(1.0);
    scene.Window->Render();
    return scene.Array("AmbientOcclusion");
  };
  EXPECT_LT(Rms(draw(1e-3, 100.0), draw(0.0, 0.0)), 0.01); // 1 : 100,000
  EXPECT_LT(Rms(draw(1e-6, 1e6), draw(0.0, 0.0)), 0.01);
}

TEST(OcclusionInScenes, PreservesTheDepthBuffer)
{
  for (const bool parallel : { false, true })
  {
    OcclusionScene scene;
    AddSphereBeforeWall(scene);
    scene.UseParallelProjection(parallel, 1.6);
    scene.Renderer->GetActiveCamera()->SetClippingRange(0.01, 900.0);
    const auto depths = [&]() {
      scene.Window->Render();
      std::vector<float> values(160 * 120);
      scene.Window->GetZbufferData(0, 0, 159, 119, values.data());
      return values;
    };
    const std::vector<float> plain = depths();
    scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
    const std::vector<float> occluded = depths();
    float largest = 0.f;
    for (std::size_t i = 0; i < plain.size(); ++i)
    {
      largest = std::max(largest, std::abs(plain[i] - occluded[i]));
    }
    EXPECT_LT(largest, 2e-6f) << (parallel ? "parallel" : "perspective");
  }
}

TEST(OcclusionInScenes, WarnsOnceIfTheMarginDoesNotFitIntoATexture)
{
  OcclusionScene scene(64, 16);
  scene.AddFloor();
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0 });
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
  scene.Window->Render();
  const int largest =
    vtkTextureObject::GetMaximumTextureSize(vtkOpenGLRenderWindow::SafeDownCast(scene.Window));
  scene.CountWarnings();
  for (const int width : { 64, largest, largest - 1, largest })
  {
    scene.Window->SetSize(width, 16);
    scene.Window->Render();
    EXPECT_EQ(scene.Warnings, width == 64 ? 0 : 1);
  }
}

TEST(OcclusionInScenes, IncludesOccludersInTheMargin)
{
  // The same scene in the middle of a larger window, and filling a smaller one.
  const auto draw = [](int width, int height, double angle, double margin) {
    OcclusionScene scene(width, height);
    AddSphereBeforeWall(scene);
    scene.Renderer->GetActiveCamera()->SetViewAngle(angle);
    scene.AddOcclusionPass(1.0)->GetConstants().Margin = margin;
    scene.Pass->SetKernelName("horizon");
    scene.Pass->SetTolerance(0.003);
    scene.Window->Render();
    return scene.Array("AmbientOcclusion");
  };
  const double small = 20.0;
  const double tangent = std::tan(small / 2.0 * std::acos(-1.0) / 180.0);
  const double large = 2.0 * std::atan(2.0 * tangent) * 180.0 / std::acos(-1.0);
  const std::vector<float> whole = draw(240, 200, large, 0.0);
  std::vector<float> middle;
  for (int j = 50; j < 150; ++j)
  {
    for (int i = 60; i < 180; ++i)
    {
      middle.push_back(whole[j * 240 + i]);
    }
  }
  const double with = Rms(draw(120, 100, small, 50.0), middle);
  EXPECT_LT(with, 0.01);
  EXPECT_GT(Rms(draw(120, 100, small, 0.0), middle), 1.4 * with);
}

TEST(OcclusionInScenes, KeepsHistoryWhileTheCameraMoves)
{
  OcclusionScene scene;
  AddSphereBeforeWall(scene);
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
  for (int frame = 0; frame < 30; ++frame)
  {
    scene.Window->Render();
  }
  for (int frame = 0; frame < 20; ++frame)
  {
    scene.Renderer->GetActiveCamera()->Azimuth(0.25);
    scene.Window->Render();
  }
  const auto statistic = [&](const char* name) {
    return scene.Pass->GetStatistics()->GetArray(name)->GetComponent(0, 0);
  };
  EXPECT_GT(statistic("Pixels/Reprojected"), 0.97);
  EXPECT_LT(statistic("Pixels/Disoccluded"), 0.03);
  const std::vector<float> moving = scene.Array("AmbientOcclusion");
  scene.Pass->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::ALWAYS);
  scene.Window->Render();
  EXPECT_LT(Rms(moving, scene.Array("AmbientOcclusion")), 0.02);
}

TEST(OcclusionInScenes, StaysSmoothWhenTheCameraStops)
{
  // The first static frames discard most of the history. They must still vary the sampled
  // directions from pixel to pixel.
  OcclusionScene scene;
  AddSphereBeforeWall(scene);
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
  scene.Pass->SetKernelName("march");
  for (int frame = 0; frame < 28; ++frame)
  {
    scene.Renderer->GetActiveCamera()->Azimuth(0.25);
    scene.Window->Render();
  }
  std::vector<std::vector<float>> frames;
  for (int frame = 0; frame < 4; ++frame)
  {
    scene.Window->Render();
    frames.push_back(scene.Array("AmbientOcclusion"));
  }
  scene.Pass->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::ALWAYS);
  scene.Pass->SetTolerance(0.003);
  scene.Window->Render();
  for (const std::vector<float>& frame : frames)
  {
    EXPECT_LT(Rms(frame, scene.Array("AmbientOcclusion")), 0.02);
  }
}

TEST(OcclusionInScenes, DiscardsOcclusionOfAMovedActor)
{
  OcclusionScene scene;
  scene.AddWall({ -3, -3, 0 }, { 6, 0, 0 }, { 0, 6, 0 });
  const auto sphere = scene.AddSphere({ -0.7, 0, 0.5 }, 0.5);
  scene.SetCamera({ 0, -5, 3 }, { 0, 0, 0.4 });
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
  for (int frame = 0; frame < 40; ++frame)
  {
    scene.Window->Render();
  }
  sphere->SetPosition(0.7, 0, 0.5);
  for (int frame = 0; frame < 12; ++frame)
  {
    scene.Window->Render();
  }
  const std::vector<float> early = scene.Array("AmbientOcclusion");
  scene.Pass->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::ALWAYS);
  scene.Pass->SetTolerance(0.005); // Discards the history.
  scene.Window->Render();
  EXPECT_LT(Rms(early, scene.Array("AmbientOcclusion")), 0.045);
}

TEST(OcclusionInScenes, IsCorrectBehindTranslucentSurfaces)
{
  // Translucent surfaces are blended over the occluded scene.
  for (const bool peeling : { false, true })
  {
    OcclusionScene scene;
    AddSphereBeforeWall(scene);
    const auto glass = scene.AddWall({ -3, -2, -3 }, { 6, 0, 0 }, { 0, 0, 6 });
    glass->GetProperty()->SetOpacity(0.5);
    glass->GetProperty()->SetColor(1, 0, 0);
    scene.Renderer->SetUseDepthPeeling(peeling);
    scene.Window->Render();
    const std::vector<int> plain = scene.Image();
    scene.AddOcclusionPass(1.0);
    scene.Window->Render();
    const std::vector<int> darkened = scene.Image();
    const std::vector<float> occlusion = scene.Array("AmbientOcclusion");
    for (std::size_t i = 0; i < occlusion.size(); ++i)
    {
      // Red with opacity 0.5 over white with occlusion a: (127.5 + 127.5 (1 - a), 127.5 (1 - a),
      // ...).
      const double green = plain[4 * i + 1] * (1.0 - occlusion[i]);
      if (occlusion[i] > 0.f)
      {
        ASSERT_NEAR(darkened[4 * i + 1], green, 2.0) << i;
        ASSERT_NEAR(darkened[4 * i], plain[4 * i] - plain[4 * i + 1] * occlusion[i], 2.0) << i;
      }
    }
  }
}

}
