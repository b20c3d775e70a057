// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The occlusion pass with other features of VTK: render passes, antialiasing, selection, overlays, and
// with windows that change.
#include "BytesInUse.h"
#include "OcclusionScene.h"

#include "Frame/OpenGLFunctions.h"

#include "vtkActor2D.h"
#include "vtkHardwareSelector.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkProperty.h"
#include "vtkProperty2D.h"
#include "vtkRenderStepsPass.h"
#include "vtkSSAAPass.h"
#include "vtkSelection.h"
#include "vtkSkybox.h"
#include "vtkStringOutputWindow.h"
#include "vtkTexture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace
{

int LargestDifference(const std::vector<int>& a, const std::vector<int>& b)
{
  int largest = a.size() == b.size() ? 0 : 255;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
  {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

/// Returns the numbers of framebuffers, buffers and programs in the current context. Textures are
/// not counted: a software renderer allocates them with malloc().
std::array<int, 3> CountObjects()
{
  unsigned int names[3] = {};
  glGenFramebuffers(1, &names[0]);
  glGenBuffers(1, &names[1]);
  names[2] = glCreateProgram();
  std::array<int, 3> counts{};
  // Drivers assign names in ascending order, so all names in use are lower than these.
  for (unsigned int name = 1; name < *std::max_element(names, names + 3); ++name)
  {
    counts[0] += glIsFramebuffer(name);
    counts[1] += glIsBuffer(name);
    counts[2] += name != names[2] && glIsProgram(name);
  }
  glDeleteFramebuffers(1, &names[0]);
  glDeleteBuffers(1, &names[1]);
  glDeleteProgram(names[2]);
  return counts;
}

TEST(OcclusionInScenes, DoesNotChangeOverlays)
{
  OcclusionScene scene;
  AddSphereBeforeWall(scene);
  vtkNew<vtkPlaneSource> label; // in pixels, across the silhouette of the scene
  label->SetOrigin(10, 80, 0);
  label->SetPoint1(60, 80, 0);
  label->SetPoint2(10, 115, 0);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputConnection(label->GetOutputPort());
  vtkNew<vtkActor2D> overlay;
  overlay->SetMapper(mapper);
  overlay->GetProperty()->SetColor(1.0, 0.5, 0.0);
  overlay->GetProperty()->SetOpacity(0.5);
  const auto overlayError = [&]() {
    overlay->VisibilityOff();
    scene.Window->Render();
    const std::vector<int> without = scene.Image();
    overlay->VisibilityOn();
    scene.Window->Render();
    const std::vector<int> with = scene.Image();
    int largest = 0;
    for (int y = 82; y < 113; ++y)
    {
      for (int x = 12; x < 58; ++x)
      {
        const std::size_t at = 4 * (static_cast<std::size_t>(y) * scene.Width + x);
        const int color[3] = { 255, 128, 0 };
        for (int c = 0; c < 3; ++c)
        {
          largest = std::max(largest, std::abs(with[at + c] - (without[at + c] + color[c]) / 2));
        }
      }
    }
    return largest;
  };
  scene.Renderer->AddViewProp(overlay);
  EXPECT_LE(overlayError(), 1);
  scene.AddOcclusionPass(1.0);
  EXPECT_LE(overlayError(), 1);
}

TEST(OcclusionInScenes, IsConfinedToItsViewport)
{
  OcclusionScene single(80, 120);
  AddSphereBeforeWall(single);
  single.AddOcclusionPass(1.0);
  single.Window->Render();
  const std::vector<int> alone = single.Image();

  OcclusionScene pair(160, 120);
  AddSphereBeforeWall(pair);
  pair.Renderer->SetViewport(0.5, 0, 1, 1);
  vtkNew<vtkRenderer> left;
  left->SetBackground(0, 1, 0);
  left->SetViewport(0, 0, 0.5, 1);
  pair.Window->AddRenderer(left);
  pair.Renderer->ResetCameraClippingRange();
  pair.AddOcclusionPass(1.0);
  vtkPenumbraTemporalSSAOPass::AddTo(left);
  pair.Window->Render();
  const std::vector<int> both = pair.Image();
  std::vector<int> right;
  for (int j = 0; j < 120; ++j)
  {
    for (int i = 0; i < 80; ++i)
    {
      const std::size_t at = static_cast<std::size_t>(j) * 160 + i;
      EXPECT_EQ(both[4 * at + 1], 255);
      EXPECT_EQ(both[4 * at], 0);
      right.insert(right.end(), &both[4 * (at + 80)], &both[4 * (at + 80)] + 4);
    }
  }
  EXPECT_LE(LargestDifference(right, alone), 1);
}

TEST(OcclusionInScenes, IsRestoredAfterResizingAndReleasingResources)
{
  OcclusionScene scene;
  AddSphereBeforeWall(scene);
  scene.AddOcclusionPass(1.0);
  scene.Window->Render();
  const std::vector<float> first = scene.Array("AmbientOcclusion");
  for (const auto& [width, height] : { std::pair<int, int>(1, 1), { 33, 7 }, { 301, 199 } })
  {
    scene.Window->SetSize(width, height);
    scene.Window->Render();
    EXPECT_EQ(scene.Array("Depth").size(), static_cast<std::size_t>(width) * height);
  }
  scene.Window->SetSize(160, 120);
  scene.Pass->ReleaseGraphicsResources(scene.Window);
  scene.Window->Render();
  EXPECT_LT(Rms(scene.Array("AmbientOcclusion"), first), 0.01);
}

/// A scene whose pass is added, rendered and removed.
struct ToggledScene : OcclusionScene
{
  ToggledScene()
    : OcclusionScene(64, 48)
  {
    AddSphereBeforeWall(*this);
    this->Window->Render();
  }

  /// Returns the number of OpenGL objects after it.
  auto Toggle(int times)
  {
    for (int time = 0; time < times; ++time)
    {
      this->AddOcclusionPass(1.0)->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
      this->Window->Render();
      vtkPenumbraTemporalSSAOPass::RemoveFrom(this->Renderer);
    }
    return CountObjects();
  }
};

TEST(OcclusionInScenes, ReleasesItsObjectsWhenToggled)
{
  ToggledScene scene;
  const auto before = scene.Toggle(5);
  EXPECT_EQ(scene.Toggle(20), before);
}

TEST(OcclusionInScenes, LeaksNoMemoryWhenToggled500Times)
{
  ToggledScene scene;
  const std::vector<int> plain = scene.Image();
  const auto before = scene.Toggle(5);
  const double bytes = penumbra::BytesInUse();
  EXPECT_EQ(scene.Toggle(495), before);
  // Mesa caches up to 2.7 MB. A leak of one texture per iteration would take 6 MB.
  EXPECT_LT(penumbra::BytesInUse() - bytes, 4e6);
  scene.Window->Render();
  EXPECT_EQ(scene.Image(), plain);
}

TEST(OcclusionInScenes, IsInsertedIntoExistingPasses)
{
  // The pass is inserted into an existing vtkRenderStepsPass, also if that is the delegate of
  // vtkSSAAPass.
  OcclusionScene scene;
  AddSphereBeforeWall(scene);
  vtkNew<vtkRenderStepsPass> steps;
  scene.Renderer->SetPass(steps);
  vtkRenderPass* opaque = steps->GetOpaquePass();
  vtkPenumbraTemporalSSAOPass* pass = vtkPenumbraTemporalSSAOPass::AddTo(scene.Renderer);
  EXPECT_EQ(vtkPenumbraTemporalSSAOPass::AddTo(scene.Renderer), pass);
  EXPECT_EQ(vtkPenumbraTemporalSSAOPass::FindIn(scene.Renderer), pass);
  EXPECT_EQ(scene.Renderer->GetPass(), steps);
  EXPECT_EQ(steps->GetOpaquePass(), pass);
  scene.Pass = pass;
  scene.Window->Render();
  const std::vector<float> occlusion = scene.Array("AmbientOcclusion");
  EXPECT_GT(*std::max_element(occlusion.begin(), occlusion.end()), 0.3f);
  vtkPenumbraTemporalSSAOPass::RemoveFrom(scene.Renderer);
  EXPECT_EQ(steps->GetOpaquePass(), opaque);

  vtkNew<vtkSSAAPass> fine;
  fine->SetDelegatePass(steps);
  scene.Renderer->SetPass(fine);
  pass = vtkPenumbraTemporalSSAOPass::AddTo(scene.Renderer);
  scene.Window->Render();
  EXPECT_EQ(steps->GetOpaquePass(), pass);
  vtkPenumbraTemporalSSAOPass::RemoveFrom(scene.Renderer);
  EXPECT_EQ(vtkPenumbraTemporalSSAOPass::FindIn(scene.Renderer), nullptr);
  EXPECT_EQ(scene.Renderer->GetPass(), fine);
  EXPECT_EQ(steps->GetOpaquePass(), opaque);
  fine->ReleaseGraphicsResources(scene.Window);
}

TEST(OcclusionInScenes, SupportsEveryAntialiasing)
{
  for (const int samples : { 0, 4 })
  {
    for (const bool fxaa : { false, true })
    {
      for (const bool peeling : { false, true })
      {
        OcclusionScene scene(80, 60, samples);
        AddSphereBeforeWall(scene);
        scene.Renderer->SetUseFXAA(fxaa);
        scene.Renderer->SetUseDepthPeeling(peeling);
        scene.Window->Render();
        const std::vector<int> plain = scene.Image();
        scene.AddOcclusionPass(1.0)->SetStrength(0.0);
        scene.Window->Render();
        EXPECT_LE(LargestDifference(scene.Image(), plain), 2)
          << samples << " samples, FXAA " << fxaa << ", peeling " << peeling;
        scene.Pass->SetStrength(1.0);
        scene.Window->Render();
        // VTK's FXAA cannot read multisampled images: with both it shows the previous image or
        // none.
        EXPECT_TRUE((fxaa && samples > 0) || LargestDifference(scene.Image(), plain) > 80)
          << samples << " samples, FXAA " << fxaa << ", peeling " << peeling;
      }
    }
  }
}

TEST(OcclusionInScenes, DoesNotChangeHardwareSelection)
{
  OcclusionScene scene;
  AddSphereBeforeWall(scene);
  const auto count = [&]() {
    vtkNew<vtkHardwareSelector> selector;
    selector->SetRenderer(scene.Renderer);
    selector->SetArea(0, 0, 159, 119);
    const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
    return selection ? selection->GetNumberOfNodes() : 0u;
  };
  scene.Window->Render();
  const unsigned int plain = count();
  scene.AddOcclusionPass(1.0);
  scene.Window->Render();
  EXPECT_EQ(count(), plain);
  EXPECT_GE(plain, 3u);
}

TEST(OcclusionInScenes, ShowsASkyboxInEveryFrame)
{
  for (const int multiSamples : { 0, 4 })
  {
    OcclusionScene scene(160, 120, multiSamples);
    AddSphereBeforeWall(scene);
    vtkNew<vtkImageData> colors;
    colors->SetDimensions(8, 8, 1);
    colors->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    for (int i = 0; i < 8 * 8 * 3; ++i)
    {
      static_cast<unsigned char*>(colors->GetScalarPointer())[i] =
        static_cast<unsigned char>(37 * i % 256);
    }
    vtkNew<vtkTexture> texture;
    texture->SetInputData(colors);
    vtkNew<vtkSkybox> skybox;
    skybox->SetProjection(vtkSkybox::Sphere);
    skybox->SetTexture(texture);
    scene.Renderer->AddActor(skybox);
    scene.SetCamera({ 0, -12, 1 }, { 0, 0, 3 });
    scene.Window->Render();
    const std::vector<int> plain = scene.Image();
    vtkPenumbraTemporalSSAOPass* pass = scene.AddOcclusionPass(1.0);
    pass->SetStrength(0.0);
    pass->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
    pass->SetTolerance(0.05);
    for (int frame = 0; frame < 3; ++frame)
    {
      scene.Window->Render();
      const std::vector<int> through = scene.Image();
      int largest = 0;
      for (std::size_t i = 0; i < plain.size(); ++i)
      {
        largest = std::max(largest, std::abs(plain[i] - through[i]));
      }
      EXPECT_LE(largest, 2) << multiSamples << " samples, frame " << frame;
    }
  }
}

TEST(OcclusionInScenes, WarnsOnceIfTheRendererUsesShadowsOrSSAO)
{
  OcclusionScene scene;
  AddSphereBeforeWall(scene);
  scene.Renderer->UseShadowsOn();
  scene.Renderer->UseSSAOOn();
  scene.AddOcclusionPass(1.0);
  vtkNew<vtkStringOutputWindow> output;
  const vtkSmartPointer<vtkOutputWindow> before = vtkOutputWindow::GetInstance();
  vtkOutputWindow::SetInstance(output);
  for (int frame = 0; frame < 3; ++frame)
  {
    scene.Window->Render();
  }
  vtkOutputWindow::SetInstance(before);
  const std::string text = output->GetOutput();
  for (const char* setting : { "UseShadows", "UseSSAO" })
  {
    EXPECT_NE(text.find(setting), std::string::npos) << text;
    EXPECT_EQ(text.find(setting), text.rfind(setting)) << text;
  }
}

TEST(OcclusionInScenes, RendersEmptyScenesAndRejectsInvalidSettings)
{
  OcclusionScene scene;
  scene.AddOcclusionPass(1.0);
  scene.Window->Render();
  EXPECT_NEAR(scene.Image()[1], 76.5, 1.0); // the background's green
  AddSphereBeforeWall(scene);
  scene.Pass->GlobalWarningDisplayOff();
  scene.Pass->SetRadius(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(scene.Pass->GetRadius(), 1.0);
  scene.Pass->SetRadius(-1.0);
  EXPECT_EQ(scene.Pass->GetRadius(), 1.0);
  scene.Pass->SetKernelName("steam");
  EXPECT_STREQ(scene.Pass->GetKernelName(), "automatic");
  scene.Pass->GlobalWarningDisplayOn();
  scene.Window->Render();
  for (const float value : scene.Array("AmbientOcclusion"))
  {
    ASSERT_TRUE(value >= 0.f && value <= 1.f);
  }
}

}
