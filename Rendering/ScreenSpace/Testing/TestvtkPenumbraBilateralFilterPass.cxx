// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionScene.h"
#include "vtkPenumbraBilateralFilterPass.h"

#include "vtkCameraPass.h"
#include "vtkFloatArray.h"
#include "vtkPointData.h"
#include "vtkProperty.h"
#include "vtkRenderStepsPass.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

/// Adds black and white strips, each two pixels wide, on a wall that fills the image. The right
/// half of the wall is one unit farther away.
void BuildScene(OcclusionScene& scene)
{
  for (int strip = 0; strip < 80; ++strip)
  {
    const double x = strip - 40.0;
    const auto wall = scene.AddWall({ x, x < 0 ? 0. : 1., -30 }, { 1, 0, 0 }, { 0, 0, 60 });
    const double shade = strip % 2;
    wall->GetProperty()->SetColor(shade, x < 0 ? shade : 1.0, shade);
  }
  scene.SetCamera({ 0, -5, 0 }, { 0, 0, 0 });
  scene.UseParallelProjection(true, 30.0);
}

vtkSmartPointer<vtkPenumbraBilateralFilterPass> AddFilterPass(OcclusionScene& scene)
{
  auto pass = vtkSmartPointer<vtkPenumbraBilateralFilterPass>::New();
  vtkNew<vtkRenderStepsPass> steps;
  pass->SetDelegatePass(steps);
  scene.Renderer->SetPass(pass);
  return pass;
}

TEST(BilateralFilterPass, ChangesNothingWithReachZero)
{
  OcclusionScene scene;
  BuildScene(scene);
  scene.Window->Render();
  const std::vector<int> plain = scene.Image();
  AddFilterPass(scene)->SetRadius(0);
  scene.Window->Render();
  EXPECT_EQ(scene.Image(), plain);
}

TEST(BilateralFilterPass, RendersInSeveralWindows)
{
  OcclusionScene scene;
  BuildScene(scene);
  const auto pass = AddFilterPass(scene);
  scene.Window->Render();
  const std::vector<int> first = scene.Image();
  OcclusionScene other;
  BuildScene(other);
  other.Renderer->SetPass(pass);
  for (OcclusionScene* target : { &other, &scene, &other })
  {
    target->Window->Render(); // Releases the resources of the other window.
    target->Window->Render();
    EXPECT_EQ(target->Image(), first);
  }
}

TEST(BilateralFilterPass, AveragesWithinSurfacesOnly)
{
  OcclusionScene scene;
  BuildScene(scene);
  const auto pass = AddFilterPass(scene);
  pass->SetRadius(3);
  pass->SetDistanceSigma(0.25);
  pass->UseDepthDistanceOn(); // All pixels of one half have the same depth and so the same weight.
  scene.Window->Render();
  const std::vector<int> image = scene.Image();
  const auto red = [&](int i) { return image[4 * (60 * 160 + i)]; };
  // Seven pixels of strips that are two pixels wide include three or four white ones.
  EXPECT_NEAR(red(40), 255.0 * 3.5 / 7.0, 255.0 * 0.5 / 7.0 + 1.0);
  // Left of the edge green equals red; right of it green is 1. No color has crossed the edge.
  for (int i = 60; i < 100; ++i)
  {
    const int green = image[4 * (60 * 160 + i) + 1];
    EXPECT_EQ(green, i < 80 ? red(i) : 255) << i;
  }
}

TEST(BilateralFilterPass, IgnoresPixelsOfWeightZero)
{
  OcclusionScene scene;
  BuildScene(scene);
  const auto pass = AddFilterPass(scene);
  pass->SetRadius(3);
  pass->SetDistanceSigma(100.0);
  pass->UseDepthDistanceOn();
  // Only white strips have a weight, so the image becomes white.
  vtkNew<vtkImageData> weights;
  weights->SetDimensions(160, 120, 1);
  weights->AllocateScalars(VTK_FLOAT, 1);
  for (int i = 0; i < 160 * 120; ++i)
  {
    static_cast<float*>(weights->GetScalarPointer())[i] = i % 160 / 2 % 2 == 1 ? 1.f : 0.f;
  }
  pass->SetWeights(weights);
  scene.Window->Render();
  const std::vector<int> image = scene.Image();
  for (int i = 8; i < 72; ++i)
  {
    EXPECT_EQ(image[4 * (60 * 160 + i)], 255) << i;
  }
}

}
