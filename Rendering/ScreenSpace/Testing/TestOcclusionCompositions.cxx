// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The table of compositions in Documentation/reference/ScreenSpacePasses.md; other rows are tested
// in TestOcclusionInScenes.cxx and TestOcclusionWithVTK.cxx.
#include "Frame/Stage.h"
#include "OcclusionScene.h"

#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageProcessingPass.h"
#include "vtkLight.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderState.h"
#include "vtkRenderStepsPass.h"
#include "vtkSSAAPass.h"
#include "vtkSphereSource.h"
#include "vtkTextureObject.h"
#include "vtkWindowToImageFilter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace
{

using Pass = vtkPenumbraTemporalSSAOPass;

int LargestDifference(const std::vector<int>& a, const std::vector<int>& b)
{
  int largest = a.size() == b.size() ? 0 : 256;
  for (std::size_t i = 0; i < a.size() && largest < 256; ++i)
  {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

double MeanDifference(const std::vector<int>& a, const std::vector<int>& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
  {
    sum += std::abs(a[i] - b[i]);
  }
  return a.size() == b.size() ? sum / static_cast<double>(a.size()) : 256.0;
}

/// A sphere on a floor. Returns the floor. Every pixel shows a white, unlit surface.
vtkSmartPointer<vtkActor> BuildSphereOnFloor(OcclusionScene& scene)
{
  const auto floor = scene.AddFloor();
  scene.AddSphere({ 0, 0, 0.5 }, 0.5);
  scene.SetCamera({ 0, -4, 3 }, { 0, 0, 0.4 });
  return floor;
}

/// Expects that the pass changes nothing with strength 0, and darkens the image with strength 1.
void ExpectRightComposition(OcclusionScene& scene)
{
  scene.Window->Render();
  const std::vector<int> plain = scene.Image();
  scene.AddOcclusionPass(1.0)->SetStrength(0.0);
  scene.Window->Render();
  EXPECT_LE(LargestDifference(scene.Image(), plain), 2);
  scene.Pass->SetStrength(1.0);
  scene.Window->Render();
  EXPECT_GT(LargestDifference(scene.Image(), plain), 50);
}

/// Renders its delegate into a floating-point texture, as passes for tone mapping do.
class FloatTargetPass : public vtkImageProcessingPass
{
public:
  static FloatTargetPass* New();
  vtkTypeMacro(FloatTargetPass, vtkImageProcessingPass);

  void Render(const vtkRenderState* state) override
  {
    vtkRenderer* renderer = state->GetRenderer();
    const int* size = renderer->GetSize();
    this->Color->SetContext(vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()));
    this->Framebuffer->SetContext(this->Color->GetContext());
    this->Color->Allocate2D(size[0], size[1], 4, VTK_FLOAT);
    this->Color->GetContext()->GetState()->PushFramebufferBindings();
    this->RenderDelegate(state, size[0], size[1], size[0], size[1], this->Framebuffer, this->Color);
    this->Color->GetContext()->GetState()->PopFramebufferBindings();
    this->Colors = penumbra::ReadBack(this->Color);
  }

  void ReleaseGraphicsResources(vtkWindow* window) override
  {
    this->Superclass::ReleaseGraphicsResources(window);
    this->Framebuffer->ReleaseGraphicsResources(window);
    this->Color->ReleaseGraphicsResources(window);
  }

  std::vector<float> Colors; ///< RGBA of the last frame

private:
  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
  vtkNew<vtkTextureObject> Color;
};
vtkStandardNewMacro(FloatTargetPass);

TEST(OcclusionCompositions, KeepTheRangeOfFloatingPointTargets)
{
  OcclusionScene scene;
  const auto floor = BuildSphereOnFloor(scene);
  floor->GetProperty()->LightingOn();
  vtkNew<vtkLight> light;
  light->SetLightTypeToHeadlight();
  light->SetIntensity(4.0);
  scene.Renderer->AddLight(light);
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<FloatTargetPass> target;
  target->SetDelegatePass(steps);
  scene.Renderer->SetPass(target);
  scene.Window->Render();
  const std::vector<float> plain = target->Colors;
  EXPECT_GT(*std::max_element(plain.begin(), plain.end()), 2.f);
  scene.AddOcclusionPass(1.0)->SetStrength(0.0);
  scene.Window->Render();
  ASSERT_EQ(target->Colors.size(), plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i)
  {
    ASSERT_NEAR(target->Colors[i], plain[i], 1e-5f) << i;
  }
  scene.Pass->SetStrength(1.0);
  scene.Window->Render();
  const std::vector<float> occlusion = scene.Array("AmbientOcclusion");
  for (std::size_t i = 0; i < occlusion.size(); ++i)
  {
    ASSERT_NEAR(target->Colors[4 * i], plain[4 * i] * (1.f - occlusion[i]), 1e-4f) << i;
  }
}

TEST(OcclusionCompositions, SupportSupersampling)
{
  OcclusionScene scene;
  BuildSphereOnFloor(scene);
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkSSAAPass> supersampling;
  supersampling->SetDelegatePass(steps);
  scene.Renderer->SetPass(supersampling);
  ExpectRightComposition(scene);
}

TEST(OcclusionCompositions, DarkenEverySampleOfAPixelByItsOwnSurface)
{
  // Spheres whose distance from the floor behind them is 1 % of that from the camera, with
  // multisamples and, as reference, at four times the resolution.
  constexpr int factor = 4;
  const auto draw = [](int scale, int samples) {
    OcclusionScene scene(120 * scale, 90 * scale, samples);
    scene.AddFloor(60.0);
    for (int i = 0; i < 6; ++i)
    {
      scene.AddSphere({ 1.3 * (i % 3) - 1.3, 1.1 * (i / 3) - 0.6, 0.5 }, 0.4);
    }
    scene.SetCamera({ 0, -68, 36 }, { 0, 0, 0.2 });
    scene.Renderer->GetActiveCamera()->SetViewAngle(2.8);
    scene.AddOcclusionPass(1.0)->SetKernelName("horizon");
    scene.Window->Render();
    return scene.Image();
  };
  const std::vector<int> image = draw(1, 4);
  const std::vector<int> large = draw(factor, 0);
  int wrong = 0;
  for (int j = 0; j < 90; ++j)
  {
    for (int i = 0; i < 120; ++i)
    {
      double sum = 0.0;
      for (int k = 0; k < factor * factor; ++k)
      {
        const std::size_t x = static_cast<std::size_t>(factor) * i + k % factor;
        const std::size_t y = static_cast<std::size_t>(factor) * j + k / factor;
        sum += large[4 * (y * 120 * factor + x)];
      }
      const double difference =
        image[4 * (static_cast<std::size_t>(j) * 120 + i)] - sum / (factor * factor);
      wrong += std::abs(difference) > 0.1 * 255;
    }
  }
  // Most of these pixels show a single surface, whose occlusion changes within a pixel.
  EXPECT_LE(wrong, 0.001 * 120 * 90);
}

TEST(OcclusionCompositions, KeepAHistoryPerEyeInStereo)
{
  for (const int type : { VTK_STEREO_LEFT, VTK_STEREO_RIGHT })
  {
    OcclusionScene scene;
    scene.AddOcclusionPass(1.0)->SetKernelName("horizon");
    scene.Window->SetStereoType(type);
    scene.Window->StereoRenderOn();
    EXPECT_LT(RootMeanSquare(ErrorsBeforeAWall(scene)), 0.03);
  }
  OcclusionScene scene;
  BuildSphereOnFloor(scene);
  scene.Renderer->GetActiveCamera()->SetEyeAngle(6.0);
  scene.Window->SetStereoTypeToAnaglyph();
  scene.Window->StereoRenderOn();
  ExpectRightComposition(scene);
  scene.Pass->SetConvergeInOneRender(Pass::NEVER);
  scene.Pass->SetKernelName("march");
  for (int frame = 0; frame < 10; ++frame)
  {
    scene.Renderer->GetActiveCamera()->Azimuth(0.25);
    scene.Window->Render();
  }
  EXPECT_GT(scene.Pass->GetStatistics()->GetArray("Pixels/Reprojected")->GetComponent(0, 0), 0.9);
  for (int frame = 0; frame < 300 && !scene.Pass->IsConverged(); ++frame)
  {
    scene.Window->Render();
  }
  EXPECT_TRUE(scene.Pass->IsConverged());
}

TEST(OcclusionCompositions, ReconstructPositionsOfBothEyes)
{
  // The positions of a floor point in both eyes, from its depth and the view of the pass, agree with
  // the depth along the view axis, which is the same for both eyes.
  std::vector<float> depths[2];
  for (int eye = 0; eye < 2; ++eye)
  {
    OcclusionScene scene;
    BuildSphereOnFloor(scene);
    scene.AddOcclusionPass(1.0);
    scene.Window->SetStereoType(eye ? VTK_STEREO_RIGHT : VTK_STEREO_LEFT);
    scene.Window->StereoRenderOn();
    scene.Window->Render();
    depths[eye] = scene.Array("Depth");
  }
  // A row of floor pixels below the sphere.
  for (int i = 0; i < 160; ++i)
  {
    EXPECT_NEAR(depths[0][10 * 160 + i], depths[1][10 * 160 + i], 1e-4) << i;
  }
}

TEST(OcclusionCompositions, WarnOnceInStereoWithParallelProjection)
{
  OcclusionScene scene;
  BuildSphereOnFloor(scene);
  scene.UseParallelProjection(true, 1.5);
  scene.Window->SetStereoTypeToAnaglyph();
  scene.Window->StereoRenderOn();
  scene.Window->Render();
  const std::vector<int> plain = scene.Image();
  scene.AddOcclusionPass(1.0);
  scene.CountWarnings();
  for (int frame = 0; frame < 3; ++frame)
  {
    scene.Window->Render();
    EXPECT_EQ(LargestDifference(scene.Image(), plain), 0);
  }
  EXPECT_EQ(scene.Warnings, 1);
}

TEST(OcclusionCompositions, LeaveOtherLayersUnchanged)
{
  OcclusionScene scene;
  BuildSphereOnFloor(scene);
  vtkNew<vtkRenderer> overlay;
  overlay->SetLayer(1);
  scene.Window->SetNumberOfLayers(2);
  scene.Window->AddRenderer(overlay);
  vtkNew<vtkSphereSource> source;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> marker;
  marker->SetMapper(mapper);
  marker->GetProperty()->SetColor(1.0, 0.2, 0.1);
  overlay->AddActor(marker);
  overlay->SetActiveCamera(scene.Renderer->GetActiveCamera());
  ExpectRightComposition(scene);
  // Every pixel of the layer keeps its colors.
  const std::vector<int> image = scene.Image();
  scene.Pass->SetStrength(0.0);
  scene.Window->Render();
  const std::vector<int> plain = scene.Image();
  int layerPixels = 0;
  for (std::size_t i = 0; i < plain.size(); i += 4)
  {
    if (plain[i] > 2 * plain[i + 1])
    {
      ++layerPixels;
      EXPECT_EQ(image[i], plain[i]);
    }
  }
  EXPECT_GT(layerPixels, 100);
}

TEST(OcclusionCompositions, AreTheSameInTilesOfALargeImage)
{
  const auto capture = [](double strength) {
    OcclusionScene scene;
    BuildSphereOnFloor(scene);
    scene.AddOcclusionPass(1.0)->SetStrength(strength);
    scene.Pass->SetKernelName("horizon");
    vtkNew<vtkWindowToImageFilter> filter;
    filter->SetInput(scene.Window);
    filter->SetScale(2);
    filter->Update();
    vtkDataArray* colors = filter->GetOutput()->GetPointData()->GetScalars();
    std::vector<int> image;
    for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
    {
      image.push_back(static_cast<int>(colors->GetComponent(i, 0)));
    }
    return image;
  };
  OcclusionScene large(320, 240);
  BuildSphereOnFloor(large);
  large.AddOcclusionPass(1.0)->SetKernelName("horizon");
  large.Window->Render();
  std::vector<int> expected;
  const std::vector<int> image = large.Image();
  for (std::size_t i = 0; i < image.size(); i += 4)
  {
    expected.push_back(image[i]);
  }
  const std::vector<int> tiles = capture(1.0);
  EXPECT_LT(MeanDifference(tiles, expected), 1.0);
  EXPECT_GT(MeanDifference(capture(0.0), expected), 5.0);
}

}
