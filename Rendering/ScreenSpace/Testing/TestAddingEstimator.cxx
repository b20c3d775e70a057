// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The history of an estimator that adds its samples to it in motion, as rays do.
#include "OcclusionScene.h"
#include "vtkPenumbraOcclusionConstants.h"
#include "vtkPenumbraOcclusionEstimator.h"

#include "vtkCamera.h"
#include "vtkObjectFactory.h"
#include "vtkTextureObject.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace
{

using Pass = vtkPenumbraTemporalSSAOPass;

/// Adds no samples in motion, so that the convergence is that of the reprojected history.
class AddingEstimator : public vtkPenumbraOcclusionEstimator
{
public:
  static AddingEstimator* New();
  vtkTypeMacro(AddingEstimator, vtkPenumbraOcclusionEstimator);

  int Estimate(const Request& request, vtkTextureObject* target) override
  {
    const std::size_t pixels = static_cast<std::size_t>(target->GetWidth()) * target->GetHeight();
    std::vector<float> values(pixels, 0.5f);
    target->Create2DFromRaw(target->GetWidth(), target->GetHeight(), 1, VTK_FLOAT, values.data());
    return request.Samples;
  }
  bool CanAddToHistory() override { return true; }
  Addition AddToHistory(const Request&, vtkTextureObject*) override { return { 1, 1 }; }
  bool NeedsMargin() override { return false; }
  void ReleaseGraphicsResources(vtkWindow*) override {}
};
vtkStandardNewMacro(AddingEstimator);

void BuildSphereOnFloor(OcclusionScene& scene)
{
  scene.AddWall({ -3, -3, 0 }, { 6, 0, 0 }, { 0, 6, 0 });
  scene.AddSphere({ 0, 0, 0.5 }, 0.5);
  scene.SetCamera({ 0, -5, 3 }, { 0, 0, 0.4 });
  scene.AddOcclusionPass(1.0)->SetConvergeInOneRender(Pass::NEVER);
  scene.Pass->GetConstants().StepsPerFrame = 1;
  scene.Pass->GetConstants().FirstSamples = 8;
}

/// Renders static frames of it with an adding estimator.
void AddSamples(OcclusionScene& scene, double invalidationWeight)
{
  BuildSphereOnFloor(scene);
  scene.Pass->GetConstants().InvalidationWeight = invalidationWeight;
  vtkNew<AddingEstimator> estimator;
  scene.Pass->SetEstimator(estimator);
  for (int frame = 0; frame < 6; ++frame)
  {
    scene.Window->Render();
  }
}

/// Returns the number of samples at a point on the floor.
double CountSamples(OcclusionScene& scene, double x, double y)
{
  return scene.Pass->GetConstants().MaximumWeight * scene.At("Convergence", { x, y, 0 });
}

}

TEST(AddingEstimator, KeepsInvalidationWeightOfAnotherOneInMotion)
{
  OcclusionScene scene;
  BuildSphereOnFloor(scene);
  scene.Pass->SetKernelName("march");
  for (int frame = 0; frame < 20; ++frame)
  {
    scene.Renderer->GetActiveCamera()->Azimuth(0.25);
    scene.Window->Render();
  }
  EXPECT_GT(CountSamples(scene, 1.0, -1.0), 60.0);
  vtkNew<AddingEstimator> estimator;
  scene.Pass->SetEstimator(estimator);
  scene.Renderer->GetActiveCamera()->Azimuth(0.25);
  scene.Window->Render();
  EXPECT_NEAR(CountSamples(scene, 1.0, -1.0), scene.Pass->GetConstants().InvalidationWeight, 1.0);
}

TEST(AddingEstimator, KeepsFewSamplesNextToMovedPropsUnlessTheCallerSetsTheirNumber)
{
  for (const auto& [weight, kept] :
    { std::pair(30.0, 0.45), std::pair(20.0, 20.0), std::pair(1000.0, 48.0) })
  {
    OcclusionScene scene;
    AddSamples(scene, weight);
    EXPECT_NEAR(CountSamples(scene, 0.0, -0.7), 48.0, 0.1);
    scene.Renderer->GetActors()->GetLastActor()->SetPosition(0.2, 0.0, 0.0);
    scene.Window->Render();
    EXPECT_NEAR(CountSamples(scene, 0.0, -0.7), kept, 0.01 * kept);
  }
}

TEST(AddingEstimator, KeepsTheHistoryOfRemovedPropsIfTheCallerSetsMaximumWeight)
{
  for (const auto& [weight, kept] : { std::pair(30.0, 0.0), std::pair(1000.0, 48.0) })
  {
    OcclusionScene scene;
    AddSamples(scene, weight);
    scene.Renderer->GetActors()->GetLastActor()->VisibilityOff();
    scene.Window->Render();
    EXPECT_NEAR(CountSamples(scene, 0.0, -0.7), kept, 0.1);
  }
}
