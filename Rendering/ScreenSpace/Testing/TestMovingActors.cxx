// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The occlusion of what moves: its history goes with it.
#include "OcclusionScene.h"

#include "vtkAssembly.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkMapper.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using Pass = vtkPenumbraTemporalSSAOPass;

double Share(OcclusionScene& scene, const char* name)
{
  return scene.Pass->GetStatistics()->GetArray(name)->GetComponent(0, 0);
}

/// Three walls that meet in a corner, with nothing else near: wherever it goes, it takes its occlusion
/// along.
struct Corner
{
  explicit Corner(int multiSamples = 0)
    : Scene(100, 75, multiSamples)
  {
    for (const Vector& side : { Vector{ 1, 0, 0 }, Vector{ 0, 1, 0 }, Vector{ 0, 0, 1 } })
    {
      const auto wall = this->Scene.AddWall({ 0, 0, 0 }, side, { side[2], side[0], side[1] });
      this->Scene.Renderer->RemoveActor(wall);
      this->Whole->AddPart(wall);
    }
    this->Scene.Renderer->AddViewProp(this->Whole);
    this->Whole->SetPosition(-1.0, 0, 0);
    this->Scene.SetCamera({ 2, 2.5, 2 }, { 0, .5, .5 });
    this->Scene.AddOcclusionPass(.5)->SetConvergeInOneRender(Pass::NEVER);
    this->Scene.Pass->SetKernelName("horizon");
  }

  void Rest(int frames)
  {
    for (int frame = 0; frame < frames; ++frame)
    {
      this->Scene.Window->Render();
    }
  }

  void Move(int frames)
  {
    for (int frame = 0; frame < frames; ++frame)
    {
      this->Whole->AddPosition(.05, 0, 0);
      this->Whole->RotateZ(-1.0);
      this->Scene.Window->Render();
    }
  }

  /// Of the last frame, against what the place converges to.
  double Error()
  {
    const std::vector<float> moving = this->Scene.Array("AmbientOcclusion");
    this->Scene.Pass->SetConvergeInOneRender(Pass::ALWAYS);
    this->Scene.Pass->SetTolerance(.006);
    this->Scene.Window->Render();
    return Rms(moving, this->Scene.Array("AmbientOcclusion"));
  }

  OcclusionScene Scene;
  vtkNew<vtkAssembly> Whole;
};

TEST(MovingActors, TakeTheirHistoryAlong)
{
  for (const int multiSamples : { 0, 4 })
  {
    double errors[2];
    double kept[2];
    for (const bool follows : { false, true })
    {
      Corner corner(multiSamples);
      corner.Scene.Pass->SetUseActorMotion(follows);
      corner.Rest(16);
      corner.Move(8);
      kept[follows] = Share(corner.Scene, "Pixels/Reprojected");
      EXPECT_EQ(Share(corner.Scene, "Pixels/ActorMotion") > .9, follows) << multiSamples;
      errors[follows] = corner.Error();
    }
    EXPECT_GT(kept[true], .85) << multiSamples;
    EXPECT_LT(kept[false], .5) << multiSamples;
    EXPECT_LT(errors[true], .5 * errors[false]) << multiSamples;
  }
}

TEST(MovingActors, AreNotLookedForWhereOnlyTheEyeMoves)
{
  Corner corner;
  corner.Rest(10);
  corner.Scene.Renderer->GetActiveCamera()->Azimuth(.25);
  corner.Scene.Window->Render();
  EXPECT_EQ(Share(corner.Scene, "Pixels/ActorMotion"), 0.0);
  EXPECT_GT(Share(corner.Scene, "Pixels/Reprojected"), .9);
}

TEST(MovingActors, AreFollowedAsRigidBodiesAlone)
{
  OcclusionScene scene;
  scene.AddFloor();
  const auto sphere = scene.AddSphere({ 0, 0, .5 }, .5);
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0 });
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(Pass::NEVER);
  for (int frame = 0; frame < 10; ++frame)
  {
    scene.Window->Render();
  }
  const auto followed = [&]() {
    scene.Window->Render();
    return Share(scene, "Pixels/ActorMotion");
  };
  sphere->SetPosition(.02, 0, .5);
  EXPECT_GT(followed(), .05);
  sphere->SetScale(1.02);
  EXPECT_EQ(followed(), 0.0);
  sphere->SetPosition(.04, 0, .5);
  sphere->GetMapper()->Modified(); // as if it drew another mesh
  EXPECT_EQ(followed(), 0.0);
  sphere->SetPosition(.06, 0, .5);
  EXPECT_GT(followed(), .05);
}

TEST(MovingActors, LeaveTheHistoryOfWhatHidesThem)
{
  // Behind a wall that fills the picture something moves fast.
  OcclusionScene scene;
  scene.AddWall({ -9, 0, -9 }, { 18, 0, 0 }, { 0, 0, 18 });
  const auto sphere = scene.AddSphere({ 0, 2, 0 }, 1.0);
  scene.SetCamera({ 0, -4, 0 }, { 0, 0, 0 });
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(Pass::NEVER);
  for (int frame = 0; frame < 10; ++frame)
  {
    sphere->AddPosition(.1, 0, 0);
    scene.Window->Render();
  }
  EXPECT_EQ(Share(scene, "Pixels/ActorMotion"), 0.0);
  EXPECT_EQ(Share(scene, "Pixels/Disoccluded"), 0.0);
}

}
