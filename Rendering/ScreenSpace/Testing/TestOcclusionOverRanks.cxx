// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Sort-last parallel rendering: every rank draws its own actors, the nearest of all pictures wins, and
// only then comes the pass. Nothing may tell how many ranks there were.
#include "DepthImage.h"
#include "OcclusionScene.h"

#include "vtkCamera.h"
#include "vtkProperty.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{

using penumbra::DepthImage;

constexpr int Width = 160;
constexpr int Height = 120;

/// Every `ranks`-th of the scene's actors, beginning with one; all under the same camera.
DepthImage Draw(int rank, int ranks)
{
  OcclusionScene scene(Width, Height);
  std::vector<vtkSmartPointer<vtkActor>> actors = { scene.AddFloor(3.0),
    scene.AddWall({ -3, 1.5, 0 }, { 6, 0, 0 }, { 0, 0, 2 }) };
  for (int i = 0; i < 6; ++i)
  {
    actors.push_back(scene.AddSphere({ .8 * i - 2.0, .3 * (i % 3), .4 }, .45));
    actors.back()->GetProperty()->SetColor(.1 * i, .5, 1.0 - .1 * i);
  }
  scene.SetCamera({ 0, -5, 3 }, { 0, 0, .4 });
  scene.Renderer->GetActiveCamera()->SetClippingRange(1.0, 20.0);
  for (int i = 0; i < static_cast<int>(actors.size()); ++i)
  {
    actors[i]->SetVisibility(i % ranks == rank);
  }
  scene.Window->Render();
  return penumbra::CaptureDepthImage(scene.Window);
}

/// The nearest of the pictures of all ranks.
DepthImage Composite(int ranks)
{
  DepthImage whole = Draw(0, ranks);
  for (int rank = 1; rank < ranks; ++rank)
  {
    penumbra::DepthComposite(whole, Draw(rank, ranks));
  }
  return whole;
}

/// The picture under the pass, in a window that knows nothing of the actors.
void Occlude(OcclusionScene& scene, int ranks)
{
  scene.SetCamera({ 0, -5, 3 }, { 0, 0, .4 });
  scene.Renderer->GetActiveCamera()->SetClippingRange(1.0, 20.0);
  vtkNew<penumbra::ShowDepthImagePass> show;
  show->Shown = Composite(ranks);
  scene.Renderer->SetPass(show);
  scene.AddOcclusionPass(1.0);
  scene.Window->Render();
}

TEST(OcclusionOverRanks, IsTheSameForOneAndForFour)
{
  OcclusionScene one(Width, Height);
  Occlude(one, 1);
  OcclusionScene four(Width, Height);
  Occlude(four, 4);
  EXPECT_STREQ(four.Pass->GetActiveKernelName(), "march"); // from depth alone
  EXPECT_EQ(one.Array("Depth"), four.Array("Depth"));
  EXPECT_EQ(one.Array("AmbientOcclusion"), four.Array("AmbientOcclusion"));
  EXPECT_EQ(one.Picture(), four.Picture());
  const std::vector<float> occlusion = one.Array("AmbientOcclusion");
  EXPECT_GT(*std::max_element(occlusion.begin(), occlusion.end()), .5f);
}

TEST(OcclusionOverRanks, IsThatOfTheSceneItself)
{
  // Up to the margin, which only the scene itself can be drawn with.
  OcclusionScene ranks(Width, Height);
  Occlude(ranks, 4);
  const DepthImage whole = Draw(0, 1);
  const std::vector<float> occlusion = ranks.Array("AmbientOcclusion");
  const std::vector<int> picture = ranks.Picture();
  for (std::size_t i = 0; i < occlusion.size(); ++i)
  {
    const float open = whole.Depths[i] < 1.f ? 1.f - occlusion[i] : 1.f;
    ASSERT_NEAR(picture[4 * i], 255.f * whole.Colors[4 * i] * open, 1.5) << i;
  }
}

}
