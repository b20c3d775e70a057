// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares ray-traced occlusion with closed forms and with brute force over the same meshes.
#include "TracedScene.h"
#include "vtkPenumbraOcclusionConstants.h"
#include "vtkPenumbraTracedEstimator.h"

#include "BruteForceOcclusion.h"

#include "vtkCamera.h"
#include "vtkCubeAxesActor.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkLookupTable.h"
#include "vtkProperty.h"
#include "vtkSMPTools.h"
#include "vtkScalarBarActor.h"
#include "vtkTexture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

using namespace penumbra_testing;

namespace
{

/// Adds an occlusion pass that traces rays.
vtkPenumbraTemporalSSAOPass* AddTracedPass(OcclusionScene& scene, double radius)
{
  vtkNew<vtkPenumbraTracedEstimator> estimator;
  estimator->SetSamplesPerRay(4);
  vtkPenumbraTemporalSSAOPass* pass = scene.AddOcclusionPass(radius);
  pass->SetEstimator(estimator);
  return pass;
}

vtkPenumbraTracedEstimator* GetEstimator(OcclusionScene& scene)
{
  return vtkPenumbraTracedEstimator::SafeDownCast(scene.Pass->GetEstimator());
}

double MaximumDifference(const std::vector<float>& a, const std::vector<float>& b)
{
  EXPECT_EQ(a.size(), b.size());
  double difference = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    difference = std::max(difference, static_cast<double>(std::abs(a[i] - b[i])));
  }
  return difference;
}

TEST(TracedEstimator, ReturnsZeroOnAnOpenPlane)
{
  OcclusionScene scene;
  scene.AddFloor();
  scene.SetCamera({ 0, -4, 1 }, { 0, 0, 0 });
  AddTracedPass(scene, 1.0);
  scene.Window->Render();
  for (const float value : scene.Array("AmbientOcclusion"))
  {
    ASSERT_EQ(value, 0.f);
  }
  EXPECT_GT(GetEstimator(scene)->GetNumberOfRays(), 0);
}

TEST(TracedEstimator, MatchesTheClosedFormNearAWall)
{
  OcclusionScene scene;
  AddTracedPass(scene, 1.0)->SetTolerance(.004);
  const std::vector<double> errors = ErrorsBeforeAWall(scene);
  for (std::size_t row = 0; row < errors.size(); ++row)
  {
    EXPECT_NEAR(errors[row], 0.0, .03) << "in row " << row;
  }
  EXPECT_LT(RootMeanSquare(errors), .005);
}

TEST(TracedEstimator, ReturnsThreeQuartersInACorner)
{
  // Floor at the foot of two perpendicular walls: a quarter of the disk stays open.
  OcclusionScene scene;
  scene.AddFloor();
  scene.AddWall({ -20, 0, 0 }, { 40, 0, 0 }, { 0, 0, 20 });
  scene.AddWall({ 0, -20, 0 }, { 0, 40, 0 }, { 0, 0, 20 });
  scene.SetCamera({ -.03, -.04, .05 }, { 0, 0, 0 });
  scene.Renderer->GetActiveCamera()->SetClippingRange(.001, 1.0);
  AddTracedPass(scene, 5.0)->SetTolerance(.004);
  scene.Window->Render();
  EXPECT_NEAR(scene.At("AmbientOcclusion", { -.001, -.001, 0 }), .75, .01);
}

TEST(TracedEstimator, MatchesTheClosedFormUnderASphere)
{
  // h / (h^2 + rho^2)^1.5 for a unit sphere whose center is h above the plane.
  OcclusionScene scene;
  scene.AddFloor(200.0);
  scene.AddSphere({ 0, 0, 1.5 }, 1.0);
  scene.SetCamera({ 0, -7, 4 }, { 0, 0, .6 });
  AddTracedPass(scene, 100.0)->SetTolerance(.004);
  scene.Window->Render();
  for (const double rho : { 1.5, 2.0, 3.0 })
  {
    const double reference = 1.5 / std::pow(1.5 * 1.5 + rho * rho, 1.5);
    EXPECT_NEAR(scene.At("AmbientOcclusion", { rho, 0, 0 }), reference, .015) << rho;
  }
}

// From its center, a quarter of a sphere at least is behind the camera. The chord at the angle a to the normal of
// a unit sphere is 2 cos(a) long, so that a radius of R blocks (R / 2)^2 of the light.
TEST(TracedEstimator, MatchesTheClosedFormAroundTheCamera)
{
  for (const double radius : { .8, 1.4, 3.0 })
  {
    OcclusionScene scene(64, 48);
    scene.AddSphere({ 0, 0, 0 }, 1.0);
    AddTracedPass(scene, radius);
    const double reference = std::min(std::pow(radius / 2.0, 2.0), 1.0);
    for (const double x : { 1.0, -1.0 })
    {
      scene.SetCamera({ 0, 0, 0 }, { x, .1, .1 });
      scene.Window->Render();
      const std::vector<float> image = scene.Array("AmbientOcclusion");
      const double mean = std::accumulate(image.begin(), image.end(), 0.0) / image.size();
      EXPECT_NEAR(mean, reference, .01) << radius << " " << x;
    }
  }
}

TEST(TracedEstimator, ConvergesToBruteForce)
{
  OcclusionScene scene(96, 72);
  AddSpheres(scene);
  AddTracedPass(scene, 1.0);
  const std::vector<float> reference = ComputeBruteForceOcclusion(scene.Renderer, 96, 72, 1.0, 24);
  scene.Window->Render();
  const double converged = Rmse(scene.Array("AmbientOcclusion"), reference);
  EXPECT_LT(converged, .015);

  // One ray per pixel and frame. The filter already makes the first frame a good estimate.
  OcclusionScene frames(96, 72);
  AddSpheres(frames);
  AddTracedPass(frames, 1.0)->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
  GetEstimator(frames)->SetSamplesPerRay(32);
  frames.Pass->GetConstants().StepsPerFrame = 1000;
  frames.Window->Render();
  const double first = Rmse(frames.Array("AmbientOcclusion"), reference);
  EXPECT_LT(first, .15);
  for (int frame = 1; frame < 16; ++frame)
  {
    frames.Window->Render();
  }
  EXPECT_LT(Rmse(frames.Array("AmbientOcclusion"), reference), .5 * first);
}

TEST(TracedEstimator, TracesOneQuarterOfThePixelsInMotion)
{
  // The image size is not a multiple of the block size.
  OcclusionScene scene(97, 71);
  AddSpheres(scene);
  vtkPenumbraTemporalSSAOPass* pass = AddTracedPass(scene, 1.0);
  GetEstimator(scene)->SetSamplesPerRay(32);
  pass->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
  const auto countRays = [&scene](int frames) {
    const long long before = GetEstimator(scene)->GetNumberOfRays();
    for (int frame = 0; frame < frames; ++frame)
    {
      scene.Renderer->GetActiveCamera()->Azimuth(.25);
      scene.Window->Render();
    }
    return static_cast<double>(GetEstimator(scene)->GetNumberOfRays() - before);
  };
  const double all = countRays(1); // without a history all pixels are traced
  EXPECT_NEAR(countRays(4) / all, 1.0, .02);
  countRays(28);
  const std::vector<float> reference = ComputeBruteForceOcclusion(scene.Renderer, 97, 71, 1.0, 24);
  EXPECT_LT(Rmse(scene.Array("AmbientOcclusion"), reference), .05);
  GetEstimator(scene)->SparseInMotionOff();
  EXPECT_NEAR(countRays(1) / all, 1.0, .02);
}

TEST(TracedEstimator, TracesEveryPixelOnceInFourFramesOfMotion)
{
  OcclusionScene scene(62, 45);
  AddSpheres(scene);
  AddTracedPass(scene, 1.0)->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
  GetEstimator(scene)->SetSamplesPerRay(32);
  scene.Window->Render();
  const std::vector<float> first = scene.Array("Convergence");
  for (int frame = 0; frame < 4; ++frame)
  {
    scene.Renderer->GetActiveCamera()->Azimuth(.001);
    scene.Window->Render();
  }
  const std::vector<float> last = scene.Array("Convergence");
  int others = 0; // at outlines, history may be discarded
  for (std::size_t i = 0; i < last.size(); ++i)
  {
    others += std::abs((last[i] - first[i]) * scene.Pass->GetConstants().MaximumWeight - 1.0) > .1;
  }
  EXPECT_LT(others, 62 * 45 / 100);
}

TEST(TracedEstimator, TracesEveryPixelWithoutHistoryInMotion)
{
  for (const int samplesPerRay : { 32, 16, 4 })
  {
    OcclusionScene scene(62, 45);
    AddSpheres(scene);
    vtkPenumbraTemporalSSAOPass* pass = AddTracedPass(scene, 1.0);
    GetEstimator(scene)->SetSamplesPerRay(samplesPerRay);
    pass->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
    pass->GetConstants().DepthTolerance =
      1e-9; // disables the history: all samples are from the last frame
    for (int frame = 0; frame < 5; ++frame)
    {
      scene.Renderer->GetActiveCamera()->Azimuth(.01);
      scene.Window->Render();
      const std::vector<float> convergence = scene.Array("Convergence");
      ASSERT_EQ(convergence.size(), 62u * 45u);
      EXPECT_GT(*std::min_element(convergence.begin(), convergence.end()),
        .9 / pass->GetConstants().MaximumWeight)
        << samplesPerRay;
    }
  }
}

TEST(TracedEstimator, TracesTinyImagesInMotion)
{
  for (const int width : { 1, 2, 3 })
  {
    const int height = width == 2 ? 3 : width;
    OcclusionScene scene(width, height);
    AddSpheres(scene);
    AddTracedPass(scene, 1.0)->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
    for (int frame = 0; frame < 5; ++frame)
    {
      scene.Renderer->GetActiveCamera()->Azimuth(.25);
      scene.Window->Render();
      const std::vector<float> occlusion = scene.Array("AmbientOcclusion");
      ASSERT_EQ(occlusion.size(), static_cast<std::size_t>(width) * height);
      for (const float value : occlusion)
      {
        EXPECT_TRUE(value >= 0.f && value <= 1.f) << value;
      }
    }
  }
}

TEST(TracedEstimator, IsIndependentOfTheClippingRange)
{
  std::vector<float> images[2];
  for (const bool wide : { false, true })
  {
    OcclusionScene scene(96, 72);
    AddSpheres(scene);
    AddTracedPass(scene, 1.0);
    scene.Renderer->GetActiveCamera()->SetClippingRange(wide ? .0005 : 1.0, 50.0);
    scene.Window->Render();
    images[wide] = scene.Array("AmbientOcclusion");
  }
  EXPECT_LT(Rmse(images[0], images[1]), .01);
}

TEST(TracedEstimator, IsIndependentOfMultisampling)
{
  // Grazing view: the depths of off-center samples are far from the plane through the pixel center.
  for (const int samples : { 0, 8 })
  {
    OcclusionScene scene(160, 120, samples);
    scene.AddFloor();
    scene.SetCamera({ 0, -4, .3 }, { 0, 0, 0 });
    AddTracedPass(scene, 1.0);
    scene.Window->Render();
    const std::vector<float> occlusions = scene.Array("AmbientOcclusion");
    EXPECT_EQ(*std::max_element(occlusions.begin(), occlusions.end()), 0.f) << samples;
  }
}

TEST(TracedEstimator, IsIndependentOfTheDistanceFromTheOrigin)
{
  std::vector<float> images[2];
  for (const bool far : { false, true })
  {
    const Vector shift = far ? Vector{ 5e5, 5e6, 0 } : Vector{ 0, 0, 0 };
    OcclusionScene scene;
    scene.AddWall({ shift[0] - 20, shift[1] - 20, 0 }, { 40, 0, 0 }, { 0, 40, 0 });
    scene.AddSphere({ shift[0], shift[1], .5 }, .5);
    scene.SetCamera({ shift[0], shift[1] - 4, 3 }, shift);
    AddTracedPass(scene, 1.0);
    scene.Window->Render();
    images[far] = scene.Array("AmbientOcclusion");
  }
  EXPECT_LT(Rmse(images[0], images[1]), 1.0 / 255);
}

TEST(TracedEstimator, IsIndependentOfThreadCount)
{
  const auto render = [](int threads) {
    std::vector<float> result;
    vtkSMPTools::LocalScope(vtkSMPTools::Config{ threads, "STDThread", false }, [&]() {
      OcclusionScene scene(96, 72);
      AddSpheres(scene);
      AddTracedPass(scene, 1.0);
      scene.Window->Render();
      result = scene.Array("AmbientOcclusion");
    });
    return result;
  };
  EXPECT_EQ(MaximumDifference(render(1), render(4)), 0.0);
}

TEST(TracedEstimator, RebuildsTheBVHOnlyWhenTheSceneChanges)
{
  OcclusionScene scene;
  scene.AddFloor();
  vtkSmartPointer<vtkActor> sphere = scene.AddSphere({ 0, 0, .5 }, .5);
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0 });
  AddTracedPass(scene, 1.0);
  scene.Window->Render();
  scene.SetCamera({ .5, -4, 3 }, { 0, 0, 0 });
  scene.Window->Render();
  EXPECT_EQ(GetEstimator(scene)->GetNumberOfTrees(), 1);
  const double before = scene.At("AmbientOcclusion", { .4, -.4, 0 });
  sphere->SetPosition(3, 0, .5);
  scene.Window->Render();
  EXPECT_EQ(GetEstimator(scene)->GetNumberOfTrees(), 2);
  EXPECT_LT(scene.At("AmbientOcclusion", { .4, -.4, 0 }), .5 * before);
}

TEST(TracedEstimator, UpdatesWhenAnOffscreenOccluderMoves)
{
  // The sphere moves outside of the image, where no depth shows it, but it occludes the floor at
  // the image edge.
  const auto render = [](bool moved) {
    OcclusionScene scene;
    scene.AddFloor();
    const auto sphere = scene.AddSphere({ moved ? 9.0 : 2.4, 0, .5 }, .5);
    scene.SetCamera({ 0, -2, 6 }, { 0, 0, 0 });
    AddTracedPass(scene, 1.5);
    scene.Window->Render();
    sphere->SetPosition(2.4, 0, .5);
    scene.Window->Render();
    return scene.Array("AmbientOcclusion");
  };
  const std::vector<float> always = render(false);
  EXPECT_GT(*std::max_element(always.begin(), always.end()), .05f);
  EXPECT_LT(Rmse(render(true), always), .01); // the accepted error
}

/// Occlusion of the floor at several distances from a wall of some opacity.
std::array<double, 3> OcclusionBeforePane(double opacity, bool byTexture = false)
{
  vtkNew<vtkImageData> veil;
  veil->SetDimensions(2, 2, 1);
  veil->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  std::fill_n(static_cast<unsigned char*>(veil->GetScalarPointer()), 16,
    static_cast<unsigned char>(std::lround(255.0 * opacity)));
  vtkNew<vtkTexture> texture;
  texture->SetInputData(veil);
  OcclusionScene scene;
  scene.AddFloor();
  const vtkSmartPointer<vtkActor> pane = scene.AddWall({ -9, 0, 0 }, { 18, 0, 0 }, { 0, 0, 9 });
  if (byTexture)
  {
    pane->SetTexture(texture);
  }
  else
  {
    pane->GetProperty()->SetOpacity(opacity);
  }
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0 });
  AddTracedPass(scene, 1.0)->SetTolerance(.004);
  scene.Window->Render();
  return { scene.At("AmbientOcclusion", { 0, -.3, 0 }),
    scene.At("AmbientOcclusion", { 0, -.45, 0 }), scene.At("AmbientOcclusion", { 0, -.6, 0 }) };
}

TEST(TracedEstimator, MultipliesOcclusionByOpacity)
{
  const double exact[] = { BehindWall(.3), BehindWall(.45), BehindWall(.6) };
  for (const double opacity : { .1, .9 })
  {
    const std::array<double, 3> found = OcclusionBeforePane(opacity);
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_NEAR(found[k], opacity * exact[k], .01) << "opacity " << opacity << ", point " << k;
    }
  }
  EXPECT_EQ(OcclusionBeforePane(0.0)[0], 0.0);
}

TEST(TracedEstimator, MultipliesOcclusionByTheAlphaOfTextures)
{
  EXPECT_NEAR(OcclusionBeforePane(.5, true)[0], .5 * BehindWall(.3), .01);
}

TEST(TracedEstimator, UpdatesTheOpacityOfAMovedSlider)
{
  OcclusionScene scene;
  scene.AddFloor();
  const vtkSmartPointer<vtkActor> pane = scene.AddWall({ -9, 0, 0 }, { 18, 0, 0 }, { 0, 0, 9 });
  pane->GetProperty()->SetOpacity(.9);
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0 });
  AddTracedPass(scene, 1.0)->SetTolerance(.004);
  scene.Window->Render();
  pane->GetProperty()->SetOpacity(.2);
  scene.Window->Render();
  EXPECT_NEAR(scene.At("AmbientOcclusion", { 0, -.3, 0 }), .2 * BehindWall(.3), .01);
}

TEST(TracedEstimator, SeesOpaqueSurfacesBehindPanes)
{
  // The pane in front of the floor changes only its occlusion, not where the floor is.
  const auto render = [](double opacity) {
    OcclusionScene scene;
    scene.AddFloor();
    scene.AddSphere({ 0, 0, .5 }, .5);
    scene.AddWall({ -9, -2.5, -1 }, { 18, 0, 0 }, { 0, 0, 9 })->GetProperty()->SetOpacity(opacity);
    scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0 });
    AddTracedPass(scene, .5)->SetTolerance(.004);
    scene.Window->Render();
    return scene.At("AmbientOcclusion", { 0, -.6, 0 });
  };
  const double occlusion = render(.5);
  EXPECT_NEAR(occlusion, render(0.0), .004);
  EXPECT_GT(occlusion, .1);
}

TEST(TracedEstimator, IsIndependentOfAnnotations)
{
  const auto render = [](bool annotated) {
    OcclusionScene scene;
    scene.AddFloor();
    scene.AddSphere({ 0, 0, .5 }, .5);
    scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0 });
    if (annotated)
    {
      vtkNew<vtkLookupTable> table;
      vtkNew<vtkScalarBarActor> bar;
      bar->SetLookupTable(table);
      bar->SetTitle("Depth");
      bar->UseOpacityOn(); // adds a texture
      scene.Renderer->AddViewProp(bar);
      vtkNew<vtkCubeAxesActor> axes;
      axes->SetBounds(-1.0, 1.0, -1.0, 1.0, 0.0, 1.0);
      axes->SetCamera(scene.Renderer->GetActiveCamera());
      scene.Renderer->AddViewProp(axes);
    }
    AddTracedPass(scene, 1.0);
    scene.Window->Render();
    return scene.At("AmbientOcclusion", { 0, -.6, 0 });
  };
  EXPECT_GT(render(false), .05);
  // The bounds determine the clipping range, and it the precision of depths.
  EXPECT_NEAR(render(true), render(false), 1e-3);
}

TEST(TracedEstimator, MatchesTheClosedFormInParallelProjection)
{
  const auto reference = [](double a) {
    return a < 1.0 ? (std::acos(a) - a * std::sqrt(1.0 - a * a)) / std::acos(-1.0) : 0.0;
  };
  OcclusionScene scene;
  scene.AddFloor();
  scene.AddWall({ -20, 0, 0 }, { 40, 0, 0 }, { 0, 0, 20 });
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0 });
  scene.Renderer->GetActiveCamera()->ParallelProjectionOn();
  scene.Renderer->GetActiveCamera()->SetParallelScale(1.5);
  AddTracedPass(scene, 1.0)->SetTolerance(.004);
  scene.Window->Render();
  for (const double y : { .2, .5, .8 })
  {
    const std::array<int, 2> pixel = scene.Pixel({ 0, -y, 0 });
    const Vector point = scene.FloorPointAt(pixel[0] + .5, pixel[1] + .5);
    EXPECT_NEAR(scene.At("AmbientOcclusion", { 0, -y, 0 }), reference(-point[1]), .015) << y;
  }
}

TEST(TracedEstimator, ReturnsZeroInAnEmptyScene)
{
  OcclusionScene scene;
  scene.AddOcclusionPass(1.0)->SetRadiusUnit(vtkPenumbraTemporalSSAOPass::WORLD);
  vtkNew<vtkPenumbraTracedEstimator> estimator;
  scene.Pass->SetEstimator(estimator);
  scene.Window->Render();
  for (const float value : scene.Array("AmbientOcclusion"))
  {
    ASSERT_EQ(value, 0.f);
  }
}

}
