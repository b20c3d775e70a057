// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Sort-last parallel rendering: every rank renders its own actors, the images are composited by
// depth, and the pass is applied to the result. The result must not depend on the number of ranks.
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

/// Renders every `ranks`-th actor of the scene, starting with number `rank`, with the same camera.
DepthImage RenderRank(int rank, int ranks)
{
  OcclusionScene scene(Width, Height);
  std::vector<vtkSmartPointer<vtkActor>> actors = { scene.AddFloor(3.0),
    scene.AddWall({ -3, 1.5, 0 }, { 6, 0, 0 }, { 0, 0, 2 }) };
  for (int i = 0; i < 6; ++i)
  {
    actors.push_back(scene.AddSphere({ 0.8 * i - 2.0, 0.3 * (i % 3), 0.4 }, 0.45));
    actors.back()->GetProperty()->SetColor(0.1 * i, 0.5, 1.0 - 0.1 * i);
  }
  scene.SetCamera({ 0, -5, 3 }, { 0, 0, 0.4 });
  scene.Renderer->GetActiveCamera()->SetClippingRange(1.0, 20.0);
  for (int i = 0; i < static_cast<int>(actors.size()); ++i)
  {
    actors[i]->SetVisibility(i % ranks == rank);
  }
  scene.Window->Render();
  return penumbra::CaptureDepthImage(scene.Window);
}

/// Returns the depth-composited image of all ranks.
DepthImage Composite(int ranks)
{
  DepthImage composite = RenderRank(0, ranks);
  for (int rank = 1; rank < ranks; ++rank)
  {
    penumbra::DepthComposite(composite, RenderRank(rank, ranks));
  }
  return composite;
}

/// Applies the pass to the composited image, in a window without the actors.
void RenderWithPass(OcclusionScene& scene, int ranks)
{
  scene.SetCamera({ 0, -5, 3 }, { 0, 0, 0.4 });
  scene.Renderer->GetActiveCamera()->SetClippingRange(1.0, 20.0);
  vtkNew<penumbra::ShowDepthImagePass> show;
  show->Shown = Composite(ranks);
  scene.Renderer->SetPass(show);
  scene.AddOcclusionPass(1.0);
  scene.Window->Render();
}

TEST(OcclusionOverRanks, IsIndependentOfTheNumberOfRanks)
{
  OcclusionScene one(Width, Height);
  RenderWithPass(one, 1);
  OcclusionScene four(Width, Height);
  RenderWithPass(four, 4);
  EXPECT_STREQ(four.Pass->GetActiveKernelName(), "march"); // needs only depth
  EXPECT_EQ(one.Array("Depth"), four.Array("Depth"));
  EXPECT_EQ(one.Array("AmbientOcclusion"), four.Array("AmbientOcclusion"));
  EXPECT_EQ(one.Image(), four.Image());
  const std::vector<float> occlusion = one.Array("AmbientOcclusion");
  EXPECT_GT(*std::max_element(occlusion.begin(), occlusion.end()), 0.5f);
}

TEST(OcclusionOverRanks, AppliesOcclusionToTheCompositedColors)
{
  OcclusionScene ranks(Width, Height);
  RenderWithPass(ranks, 4);
  const DepthImage composite = RenderRank(0, 1);
  const std::vector<float> occlusion = ranks.Array("AmbientOcclusion");
  const std::vector<int> image = ranks.Image();
  for (std::size_t i = 0; i < occlusion.size(); ++i)
  {
    const float open = composite.Depths[i] < 1.f ? 1.f - occlusion[i] : 1.f;
    ASSERT_NEAR(image[4 * i], 255.f * composite.Colors[4 * i] * open, 1.5) << i;
  }
}

}
