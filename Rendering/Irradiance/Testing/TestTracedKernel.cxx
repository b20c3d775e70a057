// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The traced estimator as the kernel "traced" of the occlusion pass: registration and selection.
#include "ManualInteractor.h"
#include "TracedScene.h"
#include "vtkPenumbraKernels.h"
#include "vtkPenumbraOcclusionConstants.h"
#include "vtkPenumbraTracedEstimator.h"

#include "BruteForceOcclusion.h"

#include "vtkCallbackCommand.h"
#include "vtkFieldData.h"
#include "vtkProperty.h"
#include "vtkSMPTools.h"
#include "vtkStringArray.h"
#include "vtkVersion.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

using namespace penumbra_testing;

TEST(TracedEstimator, IsAvailableAsKernelAfterRegistration)
{
  vtkPenumbraTracedEstimator::Register();
  OcclusionScene scene(96, 72);
  AddSpheres(scene);
  scene.AddOcclusionPass(1.0)->SetKernelName("traced");
  EXPECT_STREQ(scene.Pass->GetKernelName(), "traced");
  scene.Window->Render();
  EXPECT_STREQ(scene.Pass->GetActiveKernelName(), "traced");
  const std::vector<float> reference = ComputeBruteForceOcclusion(scene.Renderer, 96, 72, 1.0, 16);
  EXPECT_LT(Rmse(scene.Array("AmbientOcclusion"), reference), .02);
}

TEST(TracedEstimator, IsSelectedAutomaticallyIfNeededAndPossible)
{
  vtkPenumbraTracedEstimator::Register();
  OcclusionScene scene;
  scene.AddFloor();
  vtkSmartPointer<vtkActor> sphere = scene.AddSphere({ 0, 0, .5 }, .5);
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0 });
  vtkPenumbraTemporalSSAOPass* pass = scene.AddOcclusionPass(1.0);
  const auto choice = [&]() {
    scene.Window->Render();
    auto* kernel =
      vtkStringArray::SafeDownCast(pass->GetStatistics()->GetAbstractArray("Occlusion/Kernel"));
    EXPECT_EQ(kernel->GetValue(0), pass->GetActiveKernelName());
    return std::string(pass->GetActiveKernelName());
  };
  EXPECT_EQ(choice(), "traced");
  // A depth-based kernel meets this tolerance and is cheaper.
  const double bias = vtkPenumbraKernels::GetBias(vtkPenumbraKernels::Find("march"));
  pass->SetTolerance(1.01 * bias);
  EXPECT_EQ(choice(), "march");
  pass->SetTolerance(.99 * bias);
  EXPECT_EQ(choice(), "traced");
  // No BVH is built between the frames of a moving object.
  pass->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
  sphere->SetPosition(.1, 0, .5);
  EXPECT_NE(choice(), "traced");
  EXPECT_EQ(choice(), "traced");
}

TEST(TracedEstimator, IsNotSelectedForImpostorSpheresAndTubes)
{
  if (vtkVersion::GetVTKMajorVersion() == 9 && vtkVersion::GetVTKMinorVersion() < 4)
  {
    GTEST_SKIP() << "This version of VTK has no shader for tubes on meshes with normals.";
  }
  vtkPenumbraTracedEstimator::Register();
  OcclusionScene scene;
  scene.AddFloor();
  const vtkSmartPointer<vtkActor> sphere = scene.AddSphere({ 0, 0, .5 }, .5);
  vtkProperty* property = sphere->GetProperty();
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0 });
  vtkPenumbraTemporalSSAOPass* pass = scene.AddOcclusionPass(1.0);
  int warnings = 0;
  std::string last;
  vtkNew<vtkCallbackCommand> count;
  std::pair<int*, std::string*> client(&warnings, &last);
  count->SetClientData(&client);
  count->SetCallback([](vtkObject*, unsigned long, void* data, void* text) {
    auto* result = static_cast<std::pair<int*, std::string*>*>(data);
    ++*result->first;
    *result->second = static_cast<const char*>(text);
  });
  const auto choice = [&]() {
    scene.Window->Render();
    return std::string(pass->GetActiveKernelName());
  };
  property->RenderPointsAsSpheresOn(); // no effect: the surface has no vertices
  property->RenderLinesAsTubesOn();
  EXPECT_EQ(choice(), "traced");
  property->SetRepresentationToPoints();
  property->SetPointSize(8);
  EXPECT_EQ(choice(), "march");
  property->SetRepresentationToWireframe();
  EXPECT_EQ(choice(), "march");
  property->SetRepresentationToSurface();
  EXPECT_EQ(choice(), "traced");
  property->EdgeVisibilityOn();
  EXPECT_EQ(choice(), "march");

  vtkNew<vtkPenumbraTracedEstimator> estimator;
  estimator->AddObserver(vtkCommand::WarningEvent, count);
  pass->SetEstimator(estimator);
  for (const double x : { 0.0, .1, .2 })
  {
    scene.SetCamera({ x, -4, 3 }, { 0, 0, 0 });
    scene.Window->Render();
  }
  EXPECT_EQ(warnings, 1);
  EXPECT_NE(last.find("prop 1 of the renderer"), std::string::npos) << last;
  EXPECT_NE(last.find("lines as tubes"), std::string::npos) << last;
}

TEST(TracedEstimator, InterpolatesStaticViewsWithinTheTolerance)
{
  vtkPenumbraTracedEstimator::Register();
  for (const bool parallel : { false, true })
  {
    OcclusionScene scene(64, 48);
    AddSpheres(scene);
    scene.UseParallelProjection(parallel, 3.0);
    const std::vector<float> reference =
      ComputeBruteForceOcclusion(scene.Renderer, 64, 48, 1.0, 16);
    vtkPenumbraTemporalSSAOPass* pass = scene.AddOcclusionPass(1.0);
    pass->SetTolerance(.02);
    pass->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::ALWAYS);
    scene.Window->Render();
    EXPECT_LT(Rmse(scene.Array("AmbientOcclusion"), reference), .02) << parallel;
    EXPECT_TRUE(pass->IsConverged());
    EXPECT_GT(pass->GetEstimatedError(), 0.0);
    EXPECT_LE(pass->GetEstimatedError(), .02);
    // Another camera position must not reuse the previous estimate.
    scene.SetCamera({ 1, -7, 6 }, { 0, 0, 0 });
    const std::vector<float> moved = ComputeBruteForceOcclusion(scene.Renderer, 64, 48, 1.0, 16);
    scene.Window->Render();
    EXPECT_LT(Rmse(scene.Array("AmbientOcclusion"), moved), .02) << parallel;
  }
}

TEST(TracedEstimator, RefinesToTheSameImageInAnyNumberOfFrames)
{
  vtkPenumbraTracedEstimator::Register();
  const auto converge = [](int threads, int mode, int steps) {
    vtkSMPTools::Initialize(threads);
    OcclusionScene scene(64, 48);
    AddSpheres(scene);
    vtkPenumbraTemporalSSAOPass* pass = scene.AddOcclusionPass(1.0);
    pass->SetConvergeInOneRender(mode);
    pass->GetConstants().StepsPerFrame = steps;
    int frames = 0;
    for (; frames < 1000 && !pass->IsConverged(); ++frames)
    {
      scene.Window->Render();
    }
    vtkSMPTools::Initialize();
    EXPECT_TRUE(pass->IsConverged());
    EXPECT_STREQ(pass->GetActiveKernelName(), "traced");
    return std::make_pair(frames, scene.Array("AmbientOcclusion"));
  };
  const auto [frames, image] = converge(1, vtkPenumbraTemporalSSAOPass::ALWAYS, 1);
  EXPECT_EQ(frames, 1);
  // The image has the same bits for any number of steps per frame and of threads. With 0, elapsed time limits the steps
  // of a frame, so the number of frames is not tested.
  int last = 1000;
  for (const int steps : { 1, 5, 0 })
  {
    const auto [inFrames, refined] = converge(2, vtkPenumbraTemporalSSAOPass::NEVER, steps);
    EXPECT_GT(inFrames, steps == 0 ? 0 : 1);
    EXPECT_LT(inFrames, steps == 0 ? 1000 : last);
    EXPECT_TRUE(refined == image) << steps;
    last = inFrames;
  }
}

TEST(TracedEstimator, RefinesBetweenFramesWithoutRedrawing)
{
  vtkPenumbraTracedEstimator::Register();
  OcclusionScene scene(64, 48);
  AddSpheres(scene);
  vtkPenumbraTemporalSSAOPass* pass = scene.AddOcclusionPass(1.0);
  pass->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
  vtkNew<penumbra::ManualInteractor> interactor;
  interactor->SetRenderWindow(scene.Window);
  interactor->Initialize();
  int frames = 0;
  vtkNew<vtkCallbackCommand> counter;
  counter->SetClientData(&frames);
  counter->SetCallback(
    [](vtkObject*, unsigned long, void* count, void*) { ++*static_cast<int*>(count); });
  scene.Window->AddObserver(vtkCommand::EndEvent, counter);
  scene.Window->Render();
  int ticks = 0;
  for (; ticks < 1000 && !interactor->Timers.empty(); ++ticks)
  {
    interactor->Tick();
  }
  EXPECT_TRUE(pass->IsConverged());
  EXPECT_TRUE(interactor->Timers.empty());
  // The first frame, one that prepares the rays, and one for each round.
  EXPECT_LE(frames, 12);
  EXPECT_GT(ticks, 3 * frames); // of the rays of a tile each
  EXPECT_LE(pass->GetEstimatedError(), pass->GetTolerance());
}

TEST(TracedEstimator, RefinesBothEyes)
{
  vtkPenumbraTracedEstimator::Register();
  OcclusionScene scene(64, 48);
  AddSpheres(scene);
  scene.Window->StereoCapableWindowOn();
  scene.Window->SetStereoTypeToAnaglyph();
  scene.Window->StereoRenderOn();
  vtkPenumbraTemporalSSAOPass* pass = scene.AddOcclusionPass(1.0);
  pass->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
  pass->GetConstants().StepsPerFrame = 4;
  int frames = 0;
  do
  {
    scene.Window->Render();
  }
  while (++frames < 200 && !pass->IsConverged());
  EXPECT_TRUE(pass->IsConverged());
}
