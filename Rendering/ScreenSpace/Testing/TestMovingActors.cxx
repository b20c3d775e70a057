// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Temporal reprojection of the occlusion of moving actors.
#include "OcclusionScene.h"
#include "vtkPenumbraOcclusionConstants.h"

#include "vtkAssembly.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkMapper.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using Pass = vtkPenumbraTemporalSSAOPass;

double Statistic(OcclusionScene& scene, const char* name)
{
  return scene.Pass->GetStatistics()->GetArray(name)->GetComponent(0, 0);
}

/// Three walls that meet in a corner and move together. No other surface is near, so their
/// occlusion does not change.
struct Corner
{
  explicit Corner(int multiSamples = 0)
    : Scene(100, 75, multiSamples)
  {
    for (const Vector& side : { Vector{ 1, 0, 0 }, Vector{ 0, 1, 0 }, Vector{ 0, 0, 1 } })
    {
      const auto wall = this->Scene.AddWall({ 0, 0, 0 }, side, { side[2], side[0], side[1] });
      this->Scene.Renderer->RemoveActor(wall);
      this->Assembly->AddPart(wall);
    }
    this->Scene.Renderer->AddViewProp(this->Assembly);
    this->Assembly->SetPosition(-1.0, 0, 0);
    this->Scene.SetCamera({ 2, 2.5, 2 }, { 0, 0.5, 0.5 });
    this->Scene.AddOcclusionPass(0.5)->SetConvergeInOneRender(Pass::NEVER);
    this->Scene.Pass->SetKernelName("horizon");
  }

  void RenderStatic(int frames)
  {
    for (int frame = 0; frame < frames; ++frame)
    {
      this->Scene.Window->Render();
    }
  }

  void RenderMoving(int frames)
  {
    for (int frame = 0; frame < frames; ++frame)
    {
      this->Assembly->AddPosition(0.05, 0, 0);
      this->Assembly->RotateZ(-1.0);
      this->Scene.Window->Render();
    }
  }

  /// Returns the RMSE of the last frame, with the converged occlusion as reference.
  double ComputeError()
  {
    const std::vector<float> moving = this->Scene.Array("AmbientOcclusion");
    this->Scene.Pass->SetConvergeInOneRender(Pass::ALWAYS);
    this->Scene.Pass->SetTolerance(0.006);
    this->Scene.Window->Render();
    return Rms(moving, this->Scene.Array("AmbientOcclusion"));
  }

  OcclusionScene Scene;
  vtkNew<vtkAssembly> Assembly;
};

TEST(MovingActors, KeepTheirHistory)
{
  for (const int multiSamples : { 0, 4 })
  {
    double errors[2];
    double kept[2];
    for (const bool useMotion : { false, true })
    {
      Corner corner(multiSamples);
      corner.Scene.Pass->GetConstants().UseActorMotion = useMotion;
      corner.RenderStatic(16);
      corner.RenderMoving(8);
      kept[useMotion] = Statistic(corner.Scene, "Pixels/Reprojected");
      EXPECT_EQ(Statistic(corner.Scene, "Pixels/ActorMotion") > 0.9, useMotion) << multiSamples;
      errors[useMotion] = corner.ComputeError();
    }
    EXPECT_GT(kept[true], 0.75) << multiSamples;
    EXPECT_LT(kept[false], 0.5) << multiSamples;
    EXPECT_LT(errors[true], 0.9 * errors[false]) << multiSamples;
  }
}

TEST(MovingActors, AreStaticIfOnlyTheirColorChanges)
{
  OcclusionScene scene;
  scene.AddFloor();
  const auto sphere = scene.AddSphere({ 0, 0, 0.5 }, 0.5);
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0 });
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(Pass::NEVER);
  for (int frame = 0; frame < 6; ++frame)
  {
    sphere->AddPosition(0.02, 0, 0);
    scene.Window->Render();
  }
  EXPECT_EQ(Statistic(scene, "Samples/Static"), 0.0);
  // The depths are compared in one of eight frames, and the result is known four frames later.
  for (int frame = 0; frame < 14; ++frame)
  {
    sphere->GetProperty()->SetColor(1.0, 0.05 * frame, 0.0);
    scene.Window->Render();
  }
  EXPECT_GT(Statistic(scene, "Samples/Static"), 0.0);
}

TEST(MovingActors, HaveNoMotionIfOnlyTheCameraMoves)
{
  Corner corner;
  corner.RenderStatic(10);
  corner.Scene.Renderer->GetActiveCamera()->Azimuth(0.25);
  corner.Scene.Window->Render();
  EXPECT_EQ(Statistic(corner.Scene, "Pixels/ActorMotion"), 0.0);
  EXPECT_GT(Statistic(corner.Scene, "Pixels/Reprojected"), 0.9);
}

TEST(MovingActors, AreReprojectedOnlyForRigidMotion)
{
  OcclusionScene scene;
  scene.AddFloor();
  const auto sphere = scene.AddSphere({ 0, 0, 0.5 }, 0.5);
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0 });
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(Pass::NEVER);
  for (int frame = 0; frame < 10; ++frame)
  {
    scene.Window->Render();
  }
  const auto renderAndGetReprojected = [&]() {
    scene.Window->Render();
    return Statistic(scene, "Pixels/ActorMotion");
  };
  sphere->SetPosition(0.02, 0, 0.5);
  EXPECT_GT(renderAndGetReprojected(), 0.05);
  sphere->SetScale(1.02);
  EXPECT_EQ(renderAndGetReprojected(), 0.0);
  sphere->SetPosition(0.04, 0, 0.5);
  sphere->GetMapper()->Modified(); // as if the mesh had changed
  EXPECT_EQ(renderAndGetReprojected(), 0.0);
  sphere->SetPosition(0.06, 0, 0.5);
  EXPECT_GT(renderAndGetReprojected(), 0.05);
}

TEST(MovingActors, DoNotAffectTheHistoryOfTheirOccluders)
{
  // A sphere moves behind a wall that fills the image.
  OcclusionScene scene;
  scene.AddWall({ -9, 0, -9 }, { 18, 0, 0 }, { 0, 0, 18 });
  const auto sphere = scene.AddSphere({ 0, 2, 0 }, 1.0);
  scene.SetCamera({ 0, -4, 0 }, { 0, 0, 0 });
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(Pass::NEVER);
  for (int frame = 0; frame < 10; ++frame)
  {
    sphere->AddPosition(0.1, 0, 0);
    scene.Window->Render();
  }
  EXPECT_EQ(Statistic(scene, "Pixels/ActorMotion"), 0.0);
  EXPECT_EQ(Statistic(scene, "Pixels/Disoccluded"), 0.0);
}

}
