// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Frames that a window with an interactor renders by itself, and frames that are interrupted.
#include "ManualInteractor.h"
#include "OcclusionScene.h"
#include "vtkPenumbraOcclusionConstants.h"
#include "vtkPenumbraOcclusionEstimator.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkObjectFactory.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using Pass = vtkPenumbraTemporalSSAOPass;
using penumbra::ManualInteractor;

/// An interactor with a single timer, like the Qt widget of VTK's Python package.
class OneTimerInteractor : public ManualInteractor
{
public:
  static OneTimerInteractor* New();
  vtkTypeMacro(OneTimerInteractor, ManualInteractor);

protected:
  int InternalDestroyTimer(int timer) override
  {
    const int destroyed = this->ManualInteractor::InternalDestroyTimer(timer);
    this->Timers.clear();
    return destroyed;
  }
};
vtkStandardNewMacro(OneTimerInteractor);

/// Adds up the seconds that it is given between frames, and never has an image.
class TimedEstimator : public vtkPenumbraOcclusionEstimator
{
public:
  static TimedEstimator* New();
  vtkTypeMacro(TimedEstimator, vtkPenumbraOcclusionEstimator);

  int Estimate(const Request&, vtkTextureObject*) override { return 1; }
  bool CanRefine() override { return true; }
  bool RefineBetweenFrames(vtkRenderer*, double seconds) override
  {
    this->Seconds += seconds;
    return false;
  }
  void ReleaseGraphicsResources(vtkWindow*) override {}

  double Seconds = 0.0;
};
vtkStandardNewMacro(TimedEstimator);

/// A sphere on a floor, in a window that converges over several frames and counts them.
class StaticViewRefinement : public ::testing::Test
{
protected:
  StaticViewRefinement()
  {
    Build(this->Scene);
    vtkNew<vtkCallbackCommand> counter;
    counter->SetClientData(&this->Frames);
    counter->SetCallback(
      [](vtkObject*, unsigned long, void* frames, void*) { ++*static_cast<int*>(frames); });
    this->Scene.Window->AddObserver(vtkCommand::EndEvent, counter);
    this->Interactor->SetRenderWindow(this->Scene.Window);
    this->Interactor->Initialize();
  }

  static void Build(OcclusionScene& scene)
  {
    scene.AddWall({ -3, -3, 0 }, { 6, 0, 0 }, { 0, 6, 0 });
    scene.AddSphere({ 0, 0, 0.5 }, 0.5);
    scene.SetCamera({ 0, -5, 3 }, { 0, 0, 0.4 });
    scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(Pass::NEVER);
    scene.Pass->SetKernelName("march");
    scene.Pass->SetTolerance(0.01);
  }

  /// Lets the time of a frame end it after each step of samples, or few.
  static void TakeShortFrames(OcclusionScene& scene)
  {
    scene.Pass->GetConstants().StepsPerFrame = 0;
    scene.Pass->SetFrameTime(0.001);
  }

  /// Renders a frame of the application and returns the number of frames of `ticks` ticks.
  int FramesAfter(int ticks)
  {
    this->Scene.Window->Render();
    this->Frames = 0;
    this->Interactor->Tick(ticks);
    return this->Frames;
  }

  double Statistic(const char* name)
  {
    return this->Scene.Pass->GetStatistics()->GetArray(name)->GetComponent(0, 0);
  }

  OcclusionScene Scene;
  vtkNew<ManualInteractor> Interactor;
  int Frames = 0;
};

/// Moves an actor at each event of the window.
void MoveAt(unsigned long event, vtkRenderWindow* window, vtkActor* actor)
{
  vtkNew<vtkCallbackCommand> mover;
  mover->SetClientData(actor);
  mover->SetCallback([](vtkObject*, unsigned long, void* moved, void*) {
    static_cast<vtkActor*>(moved)->AddPosition(0.01, 0.0, 0.0);
  });
  window->AddObserver(event, mover);
}

TEST_F(StaticViewRefinement, RendersFramesUntilConvergedAndThenNone)
{
  OcclusionScene manual;
  Build(manual);
  int needed = 0;
  for (; needed < 1000 && !manual.Pass->IsConverged(); ++needed)
  {
    manual.Window->Render();
  }
  EXPECT_EQ(needed, 1 + this->FramesAfter(1000));
  EXPECT_TRUE(this->Scene.Pass->IsConverged());
  EXPECT_TRUE(this->Interactor->Timers.empty());
  EXPECT_EQ(manual.Image(), this->Scene.Image());
  EXPECT_EQ(0, this->FramesAfter(1000));
  this->Scene.Renderer->GetActiveCamera()->Azimuth(1.0);
  EXPECT_LT(10, this->FramesAfter(1000));
  EXPECT_TRUE(this->Scene.Pass->IsConverged());
}

TEST_F(StaticViewRefinement, AddsSamplesBetweenFramesAndDrawsEachFourfoldNumber)
{
  OcclusionScene manual;
  Build(manual);
  TakeShortFrames(manual);
  for (int i = 0; i < 1000 && !manual.Pass->IsConverged(); ++i)
  {
    manual.Window->Render();
  }
  TakeShortFrames(this->Scene);
  const int frames = this->FramesAfter(1000);
  EXPECT_TRUE(this->Scene.Pass->IsConverged());
  EXPECT_TRUE(this->Interactor->Timers.empty());
  EXPECT_EQ(manual.Image(), this->Scene.Image());
  const double samples = this->Statistic("Samples/Static");
  EXPECT_EQ(manual.Pass->GetStatistics()->GetArray("Samples/Static")->GetComponent(0, 0), samples);
  EXPECT_GE(samples, 512.0);
  // The first static frame, one per fourfold number of samples, and the converged one.
  EXPECT_LE(frames, 2 + static_cast<int>(std::log2(samples / 32.0) / 2.0));
}

TEST_F(StaticViewRefinement, AddsSamplesBetweenFramesOfBothEyes)
{
  TakeShortFrames(this->Scene);
  this->Scene.Window->SetStereoTypeToAnaglyph();
  this->Scene.Window->StereoRenderOn();
  EXPECT_LE(this->FramesAfter(1000), 8);
  EXPECT_TRUE(this->Scene.Pass->IsConverged());
  EXPECT_TRUE(this->Interactor->Timers.empty());
}

TEST_F(StaticViewRefinement, EndsIfOnlyOneEyeOfTwoUnfinishedOnesIsStillRendered)
{
  for (const int type : { VTK_STEREO_LEFT, VTK_STEREO_RIGHT })
  {
    TakeShortFrames(this->Scene);
    this->Scene.Renderer->GetActiveCamera()->Azimuth(1.0);
    this->Scene.Window->SetStereoTypeToAnaglyph();
    this->Scene.Window->StereoRenderOn();
    this->FramesAfter(6);
    EXPECT_FALSE(this->Scene.Pass->IsConverged());
    this->Scene.Window->SetStereoType(type);
    EXPECT_LE(this->FramesAfter(1000), 8);
    EXPECT_TRUE(this->Scene.Pass->IsConverged());
    EXPECT_TRUE(this->Interactor->Timers.empty());
  }
}

TEST_F(StaticViewRefinement, DropsSamplesBetweenFramesWhenTheSceneChanges)
{
  TakeShortFrames(this->Scene);
  this->FramesAfter(10);
  this->Scene.AddSphere({ 1, 0, 0.5 }, 0.4);
  this->FramesAfter(1000);
  EXPECT_TRUE(this->Scene.Pass->IsConverged());
  OcclusionScene other;
  Build(other);
  other.AddSphere({ 1, 0, 0.5 }, 0.4);
  other.Pass->SetConvergeInOneRender(Pass::ALWAYS);
  other.Window->Render();
  EXPECT_LT(Rms(other.Array("AmbientOcclusion"), this->Scene.Array("AmbientOcclusion")), 0.01);
}

TEST_F(StaticViewRefinement, StopsDuringInteraction)
{
  EXPECT_EQ(5, this->FramesAfter(10));
  this->Scene.Window->SetDesiredUpdateRate(15.0); // as an interactor style does on a button press
  this->Frames = 0;
  this->Interactor->Tick(1);
  EXPECT_EQ(0, this->Frames);
  EXPECT_TRUE(this->Interactor->Timers.empty());
  EXPECT_EQ(0, this->FramesAfter(100));
  EXPECT_TRUE(this->Interactor->Timers.empty());
  this->Scene.Window->SetDesiredUpdateRate(0.0001);
  EXPECT_LT(10, this->FramesAfter(1000));
  EXPECT_TRUE(this->Scene.Pass->IsConverged());
}

TEST_F(StaticViewRefinement, WaitsWhileTheApplicationRenders)
{
  for (int i = 0; i < 20; ++i)
  {
    this->Scene.Renderer->GetActiveCamera()->Azimuth(0.2);
    EXPECT_EQ(0, this->FramesAfter(3));
  }
  EXPECT_EQ(1u, this->Interactor->Timers.size());
}

TEST_F(StaticViewRefinement, StopsIfTheSceneChangesInEveryFrame)
{
  vtkActor* actor = this->Scene.AddSphere({ 1, 0, 0.5 }, 0.3);
  MoveAt(vtkCommand::StartEvent, this->Scene.Window, actor);
  EXPECT_EQ(1, this->FramesAfter(100));
}

TEST_F(StaticViewRefinement, StopsIfTheSceneChangesAfterEveryFrame)
{
  vtkActor* actor = this->Scene.AddSphere({ 1, 0, 0.5 }, 0.3);
  MoveAt(vtkCommand::EndEvent, this->Scene.Window, actor);
  EXPECT_GE(2, this->FramesAfter(100));
  EXPECT_TRUE(this->Interactor->Timers.empty());
}

TEST_F(StaticViewRefinement, StopsIfTheScenesOfTwoPassesChangeInEveryFrame)
{
  this->Scene.Renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  vtkNew<vtkRenderer> second;
  second->SetViewport(0.5, 0.0, 1.0, 1.0);
  this->Scene.Window->AddRenderer(second);
  Pass::AddTo(second)->SetConvergeInOneRender(Pass::NEVER);
  vtkSmartPointer<vtkActor> actor = this->Scene.AddSphere({ 1, 0, 0.5 }, 0.3);
  second->AddViewProp(actor);
  MoveAt(vtkCommand::StartEvent, this->Scene.Window, actor);
  EXPECT_GE(2, this->FramesAfter(100));
  EXPECT_TRUE(this->Interactor->Timers.empty());
}

TEST_F(StaticViewRefinement, ConvergesAfterAChangeWithoutAFrame)
{
  vtkSmartPointer<vtkActor> actor = this->Scene.AddSphere({ 1, 0, 0.5 }, 0.4);
  for (const bool takesShortFrames : { false, true })
  {
    if (takesShortFrames)
    {
      TakeShortFrames(this->Scene);
    }
    actor->VisibilityOn();
    this->FramesAfter(8);
    EXPECT_FALSE(this->Scene.Pass->IsConverged());
    actor->VisibilityOff();
    this->Interactor->Tick(1000);
    EXPECT_TRUE(this->Scene.Pass->IsConverged());
    EXPECT_TRUE(this->Interactor->Timers.empty());
    OcclusionScene other;
    Build(other);
    other.Pass->SetConvergeInOneRender(Pass::ALWAYS);
    other.Window->Render();
    EXPECT_LT(Rms(other.Array("AmbientOcclusion"), this->Scene.Array("AmbientOcclusion")), 0.01);
  }
}

TEST_F(StaticViewRefinement, AllowsThatAnObserverOfAFrameRemovesThePass)
{
  this->FramesAfter(6);
  vtkNew<vtkCallbackCommand> remover;
  remover->SetClientData(this->Scene.Renderer);
  remover->SetCallback([](vtkObject*, unsigned long, void* renderer, void*) {
    Pass::RemoveFrom(static_cast<vtkRenderer*>(renderer));
  });
  this->Scene.Window->AddObserver(vtkCommand::EndEvent, remover);
  this->Frames = 0;
  this->Interactor->Tick(100);
  EXPECT_EQ(1, this->Frames);
  EXPECT_TRUE(this->Interactor->Timers.empty());
}

TEST_F(StaticViewRefinement, StopsWithThePass)
{
  this->Scene.Pass->RefineStaticViewOff();
  EXPECT_EQ(0, this->FramesAfter(100));
  this->Scene.Pass->RefineStaticViewOn();
  EXPECT_EQ(5, this->FramesAfter(10));
  Pass::RemoveFrom(this->Scene.Renderer);
  EXPECT_TRUE(this->Interactor->Timers.empty());
  EXPECT_EQ(0, this->FramesAfter(100));
}

TEST_F(StaticViewRefinement, RendersOneFramePerTickForSeveralViewports)
{
  this->Scene.Renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  vtkNew<vtkRenderer> second;
  second->SetViewport(0.5, 0.0, 1.0, 1.0);
  second->AddViewProp(this->Scene.AddSphere({ 1, 0, 0.5 }, 0.3));
  this->Scene.Window->AddRenderer(second);
  Pass* pass = Pass::AddTo(second);
  pass->SetConvergeInOneRender(Pass::NEVER);
  const int frames = this->FramesAfter(25);
  EXPECT_GT(frames, 10);
  EXPECT_LE(frames, 20);
  this->Interactor->Tick(1000);
  EXPECT_TRUE(this->Scene.Pass->IsConverged() && pass->IsConverged());
  EXPECT_TRUE(this->Interactor->Timers.empty());
}

TEST_F(StaticViewRefinement, ConvergesInAllViewportsIfTheInteractorHasOneTimer)
{
  vtkNew<OneTimerInteractor> interactor;
  interactor->SetRenderWindow(this->Scene.Window);
  interactor->Initialize();
  this->Scene.Renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  vtkNew<vtkRenderer> second;
  second->SetViewport(0.5, 0.0, 1.0, 1.0);
  second->AddViewProp(this->Scene.AddSphere({ 1, 0, 0.5 }, 0.3));
  this->Scene.Window->AddRenderer(second);
  Pass* pass = Pass::AddTo(second);
  pass->SetConvergeInOneRender(Pass::NEVER);
  pass->SetTolerance(1.0);
  this->Scene.Window->Render();
  interactor->Tick(1000);
  EXPECT_TRUE(pass->IsConverged());
  EXPECT_TRUE(this->Scene.Pass->IsConverged());
  EXPECT_TRUE(interactor->Timers.empty());
}

TEST_F(StaticViewRefinement, SharesTheTimeOfATickAmongTheViewportsOfAWindow)
{
  constexpr double FrameTime = 0.03;
  vtkNew<TimedEstimator> estimator;
  TakeShortFrames(this->Scene);
  this->Scene.Renderer->SetViewport(0.0, 0.0, 0.25, 1.0);
  std::vector<Pass*> passes = { this->Scene.Pass };
  for (int i = 1; i < 4; ++i)
  {
    vtkNew<vtkRenderer> renderer;
    renderer->SetViewport(0.25 * i, 0.0, 0.25 * i + 0.25, 1.0);
    renderer->AddViewProp(this->Scene.AddSphere({ 1, 0, 0.5 }, 0.3));
    this->Scene.Window->AddRenderer(renderer);
    passes.push_back(Pass::AddTo(renderer));
    passes.back()->SetConvergeInOneRender(Pass::NEVER);
  }
  for (Pass* pass : passes)
  {
    pass->SetEstimator(estimator);
    pass->SetFrameTime(FrameTime);
  }
  this->FramesAfter(10);
  EXPECT_NEAR(5 * FrameTime, estimator->Seconds, 1e-9);
}

TEST_F(StaticViewRefinement, IsNotNeededIfOneRenderConverges)
{
  this->Scene.Pass->SetConvergeInOneRender(Pass::ALWAYS);
  EXPECT_EQ(0, this->FramesAfter(100));
  EXPECT_TRUE(this->Scene.Pass->IsConverged());
}

TEST_F(StaticViewRefinement, RendersInteractiveFramesOffscreenDuringInteraction)
{
  this->Scene.Pass->SetConvergeInOneRender(Pass::OFFSCREEN);
  this->Scene.Window->SetDesiredUpdateRate(15.0);
  for (int i = 0; i < 5; ++i)
  {
    this->Scene.Renderer->GetActiveCamera()->Azimuth(0.2);
    this->Scene.Window->Render();
    EXPECT_FALSE(this->Scene.Pass->IsConverged());
    EXPECT_LE(this->Statistic("Samples/PerPixel"), 32.0);
  }
  EXPECT_GT(this->Statistic("Pixels/Reprojected"), 0.5);
  this->Scene.Window->SetDesiredUpdateRate(0.0001);
  this->Scene.Window->Render();
  EXPECT_TRUE(this->Scene.Pass->IsConverged());
}

TEST_F(StaticViewRefinement, LetsAnAbortInterruptConvergingInOneRender)
{
  OcclusionScene uninterrupted;
  Build(uninterrupted);
  uninterrupted.Pass->SetConvergeInOneRender(Pass::ALWAYS);
  uninterrupted.Window->Render();

  this->Scene.Pass->SetConvergeInOneRender(Pass::ALWAYS);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* window, unsigned long, void*, void*) {
    static_cast<vtkRenderWindow*>(window)->SetAbortRender(1);
  });
  const unsigned long tag = this->Scene.Window->AddObserver(vtkCommand::AbortCheckEvent, abort);
  this->Scene.Window->Render();
  EXPECT_FALSE(this->Scene.Pass->IsConverged());
  this->Scene.Window->RemoveObserver(tag);
  this->Scene.Window->Render();
  EXPECT_TRUE(this->Scene.Pass->IsConverged());
  EXPECT_LT(
    Rms(uninterrupted.Array("AmbientOcclusion"), this->Scene.Array("AmbientOcclusion")), 0.01);
}

TEST_F(StaticViewRefinement, CountsTheSamePixelsAsTheArrays)
{
  this->Scene.Window->Render();
  for (int frame = 0; frame < 8; ++frame)
  {
    this->Scene.Renderer->GetActiveCamera()->Azimuth(2.0);
    this->Scene.Window->Render();
  }
  const double spatialConvergence = this->Scene.Pass->GetConstants().SpatialConvergence;
  const double newConvergence =
    this->Scene.Pass->GetConstants().FirstSamples / this->Scene.Pass->GetConstants().MaximumWeight;
  const std::vector<float> depths = this->Scene.Array("Depth");
  const std::vector<float> convergences = this->Scene.Array("Convergence");
  double surface = 0.0;
  double converged = 0.0;
  double disoccluded = 0.0;
  for (std::size_t i = 0; i < depths.size(); ++i)
  {
    surface += std::isfinite(depths[i]);
    converged += std::isfinite(depths[i]) && convergences[i] >= spatialConvergence;
    disoccluded += std::isfinite(depths[i]) && convergences[i] < 1.0001 * newConvergence;
  }
  EXPECT_GT(disoccluded, 10.0);
  EXPECT_NEAR(disoccluded / surface, this->Statistic("Pixels/Disoccluded"), 1e-6);
  EXPECT_NEAR(converged / surface, this->Statistic("Pixels/Converged"), 1e-6);
}

}
