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

/// Black and white strips, two pixels wide each, on a wall that fills the picture; its right half
/// lies one unit behind.
void Furnish(OcclusionScene& scene)
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

vtkSmartPointer<vtkPenumbraBilateralFilterPass> Filter(OcclusionScene& scene)
{
  auto pass = vtkSmartPointer<vtkPenumbraBilateralFilterPass>::New();
  vtkNew<vtkRenderStepsPass> steps;
  pass->SetDelegatePass(steps);
  scene.Renderer->SetPass(pass);
  return pass;
}

TEST(BilateralFilterPass, WithReachZeroChangesNothing)
{
  OcclusionScene scene;
  Furnish(scene);
  scene.Window->Render();
  const std::vector<int> plain = scene.Picture();
  Filter(scene)->SetReach(0);
  scene.Window->Render();
  EXPECT_EQ(scene.Picture(), plain);
}

TEST(BilateralFilterPass, MovesFromWindowToWindow)
{
  OcclusionScene scene;
  Furnish(scene);
  const auto pass = Filter(scene);
  scene.Window->Render();
  const std::vector<int> first = scene.Picture();
  OcclusionScene other;
  Furnish(other);
  other.Renderer->SetPass(pass);
  for (OcclusionScene* each : { &other, &scene, &other })
  {
    each->Window->Render(); // what was made in the other window is released
    each->Window->Render();
    EXPECT_EQ(each->Picture(), first);
  }
}

TEST(BilateralFilterPass, AveragesWithinASurfaceAndNeverAcrossAnEdge)
{
  OcclusionScene scene;
  Furnish(scene);
  const auto pass = Filter(scene);
  pass->SetReach(3);
  pass->SetDistance(.25);
  pass->ByDepthOn(); // all of a wall has one depth: its pixels count the same
  scene.Window->Render();
  const std::vector<int> picture = scene.Picture();
  const auto red = [&](int i) { return picture[4 * (60 * 160 + i)]; };
  // Seven pixels of strips two wide hold three or four white ones.
  EXPECT_NEAR(red(40), 255.0 * 3.5 / 7.0, 255.0 * .5 / 7.0 + 1.0);
  // Left of the edge green is as red, right of it all is 1: nothing came across.
  for (int i = 60; i < 100; ++i)
  {
    const int green = picture[4 * (60 * 160 + i) + 1];
    EXPECT_EQ(green, i < 80 ? red(i) : 255) << i;
  }
}

TEST(BilateralFilterPass, LetsPixelsOfWeightZeroCountNothing)
{
  OcclusionScene scene;
  Furnish(scene);
  const auto pass = Filter(scene);
  pass->SetReach(3);
  pass->SetDistance(100.0);
  pass->ByDepthOn();
  // Only white strips count: the picture becomes white.
  vtkNew<vtkImageData> weights;
  weights->SetDimensions(160, 120, 1);
  weights->AllocateScalars(VTK_FLOAT, 1);
  for (int i = 0; i < 160 * 120; ++i)
  {
    static_cast<float*>(weights->GetScalarPointer())[i] = i % 160 / 2 % 2 == 1 ? 1.f : 0.f;
  }
  pass->SetWeights(weights);
  scene.Window->Render();
  const std::vector<int> picture = scene.Picture();
  for (int i = 8; i < 72; ++i)
  {
    EXPECT_EQ(picture[4 * (60 * 160 + i)], 255) << i;
  }
}

}
