// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares the pixels of windows whose renderers have a vtkPenumbraRayCastPass with the image of a ray
// caster. Frames are rendered until the pass says that the image is complete, however many that takes.
#include "vtkPenumbraRayCastPass.h"

#include "vtkPenumbraLightShaftPass.h"
#include "vtkPenumbraMedium.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraTemporalSSAOPass.h"

#include "vtkActor.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkHardwareSelector.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLightsPass.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkSphereSource.h"
#include "vtkTextActor.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <iostream>
#include <string>
#include <vector>

namespace
{

constexpr int Width = 120;
constexpr int Height = 90;
constexpr int MaximumFrames = 20000;

using Bytes = std::vector<unsigned char>;

vtkSmartPointer<vtkActor> AddSphere(vtkRenderer* renderer, double x)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(x, 0.0, 0.0);
  sphere->SetRadius(0.5);
  sphere->SetThetaResolution(24);
  sphere->SetPhiResolution(16);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  return actor;
}

/// Two spheres, a text, and a light.
void SetUpScene(vtkRenderer* renderer)
{
  AddSphere(renderer, -0.4)->GetProperty()->SetColor(0.9, 0.5, 0.3);
  AddSphere(renderer, 0.4);
  vtkNew<vtkTextActor> text;
  text->SetInput("rays");
  text->SetPosition(5.0, 5.0);
  renderer->AddViewProp(text);
  vtkNew<vtkLight> light;
  light->PositionalOff();
  light->SetPosition(3.0, 4.0, 5.0);
  renderer->AddLight(light);
  renderer->SetBackground(0.1, 0.2, 0.4);
  renderer->GetActiveCamera()->SetPosition(1.0, 1.5, 4.0);
  renderer->GetActiveCamera()->SetFocalPoint(0.0, 0.0, 0.0);
  renderer->ResetCameraClippingRange();
}

void CollectWarnings(vtkObject* object, std::vector<std::string>& warnings)
{
  vtkNew<vtkCallbackCommand> observer;
  observer->SetCallback([](vtkObject*, unsigned long, void* all, void* text) {
    static_cast<std::vector<std::string>*>(all)->push_back(static_cast<char*>(text));
  });
  observer->SetClientData(&warnings);
  object->AddObserver(vtkCommand::WarningEvent, observer);
}

void Configure(vtkPenumbraRayCaster* caster)
{
  caster->ShadowsOn();
  caster->AmbientOcclusionOn();
  caster->SetTolerance(0.02);
}

/// Returns the number of values that differ, or -1 if the sizes do.
long CountDifferences(const Bytes& a, const Bytes& b)
{
  long count = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    count += a[i] != b[i] ? 1 : 0;
  }
  return a.size() == b.size() ? count : -1;
}

class RayCastPass : public testing::Test
{
protected:
  void SetUp() override
  {
    SetUpScene(this->Renderer);
    Configure(this->Pass->GetRayCaster());
    this->Renderer->SetPass(this->Pass);
    this->Window->OffScreenRenderingOn();
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(Width, Height);
    this->Window->AddRenderer(this->Renderer);
    this->Pass->SetTimeLimit(0.005);
    CollectWarnings(this->Pass, this->Warnings);
  }

  void TearDown() override { this->Renderer->SetPass(nullptr); }

  Bytes GetPixels(int left = 0, int right = -1)
  {
    const int* size = this->Window->GetSize();
    vtkNew<vtkUnsignedCharArray> pixels;
    this->Window->GetPixelData(left, 0, right < 0 ? size[0] - 1 : right, size[1] - 1, 0, pixels);
    return Bytes(pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues());
  }

  /// Renders frames until the image is complete. Returns their number.
  int RenderFrames()
  {
    int frames = 0;
    do
    {
      this->Window->Render();
      ++frames;
    }
    while (!this->Pass->IsComplete() && frames < MaximumFrames);
    EXPECT_LT(frames, MaximumFrames);
    return frames;
  }

  /// Returns the pixels of a ray caster with the same settings.
  static Bytes CastRays(vtkRenderer* renderer, int width, int height)
  {
    vtkNew<vtkPenumbraRayCaster> caster;
    Configure(caster);
    caster->KeepSceneOn();
    caster->LayersOff();
    caster->SetRenderer(renderer);
    caster->SetResolution(width, height);
    caster->Update();
    vtkDataArray* colors = caster->GetOutput()->GetPointData()->GetArray("Color");
    Bytes bytes;
    for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
    {
      for (int c = 0; c < 3; ++c)
      {
        bytes.push_back(static_cast<unsigned char>(
          std::lround(255.0 * std::clamp(colors->GetComponent(i, c), 0.0, 1.0))));
      }
    }
    return bytes;
  }

  void ExpectRayCastImage()
  {
    const int* size = this->Window->GetSize();
    EXPECT_EQ(CountDifferences(this->GetPixels(), CastRays(this->Renderer, size[0], size[1])), 0);
  }

  double GetExtractions()
  {
    return this->Pass->GetRayCaster()
      ->GetStatistics()
      ->GetArray("Scene/Extractions")
      ->GetComponent(0, 0);
  }

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkPenumbraRayCastPass> Pass;
  std::vector<std::string> Warnings;
};

double ComputeRMSE(const Bytes& a, const Bytes& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += (a[i] - b[i]) * (a[i] - b[i]);
  }
  return std::sqrt(sum / static_cast<double>(a.size())) / 255.0;
}

TEST_F(RayCastPass, GrowsFromPreviewToImageOfRayCaster)
{
  this->Window->Render();
  const Bytes preview = this->GetPixels();
  const double estimate = this->Pass->GetRayCaster()->GetEstimatedError();
  const int frames = this->RenderFrames();
  RecordProperty("Frames", frames);
  this->ExpectRayCastImage();
  const Bytes complete = this->GetPixels();
  const double error = ComputeRMSE(preview, complete);
  RecordProperty("RMSE", std::to_string(error));
  EXPECT_LT(error, 2.0 * estimate);
  EXPECT_LT(error, 0.2);
  EXPECT_LT(this->Pass->GetRayCaster()->GetEstimatedError(), 0.03);
  this->Window->Render();
  EXPECT_TRUE(this->Pass->IsComplete());
  EXPECT_EQ(CountDifferences(this->GetPixels(), complete), 0);
  EXPECT_TRUE(this->Warnings.empty());
}

TEST_F(RayCastPass, RestartsAfterChangesWithKeptScene)
{
  this->RenderFrames();
  this->Renderer->GetActiveCamera()->Azimuth(20.0);
  this->Window->Render();
  EXPECT_EQ(this->GetExtractions(), 0.0);
  this->RenderFrames();
  this->ExpectRayCastImage();
  // A change before the image is complete.
  this->Renderer->GetActiveCamera()->Elevation(5.0);
  this->Window->Render();
  AddSphere(this->Renderer, 1.2);
  this->Window->Render();
  this->RenderFrames();
  this->ExpectRayCastImage();
  this->Renderer->SetBackground(0.6, 0.6, 0.6);
  this->RenderFrames();
  this->ExpectRayCastImage();
}

TEST_F(RayCastPass, FollowsSizeAndSettings)
{
  this->Window->Render();
  this->Window->SetSize(80, 100);
  this->RenderFrames();
  this->ExpectRayCastImage();
  const Bytes before = this->GetPixels();
  this->Pass->GetRayCaster()->SetAmbientOcclusion(false);
  this->RenderFrames();
  EXPECT_NE(this->GetPixels(), before);
  this->Pass->GetRayCaster()->SetAmbientOcclusion(true);
  this->RenderFrames();
  EXPECT_EQ(CountDifferences(this->GetPixels(), before), 0);
}

TEST_F(RayCastPass, SurvivesReleaseOfResourcesAndOtherWindows)
{
  this->RenderFrames();
  this->Pass->ReleaseGraphicsResources(this->Window);
  this->RenderFrames();
  this->ExpectRayCastImage();
  this->Window->RemoveRenderer(this->Renderer);
  vtkNew<vtkRenderWindow> other;
  other->OffScreenRenderingOn();
  other->SetMultiSamples(0);
  other->SetSize(Width, Height);
  other->AddRenderer(this->Renderer);
  other->Render();
  for (int i = 0; !this->Pass->IsComplete() && i < MaximumFrames; ++i)
  {
    other->Render();
  }
  vtkNew<vtkUnsignedCharArray> pixels;
  other->GetPixelData(0, 0, Width - 1, Height - 1, 0, pixels);
  const Bytes shown(pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues());
  EXPECT_EQ(CountDifferences(shown, CastRays(this->Renderer, Width, Height)), 0);
  other->RemoveRenderer(this->Renderer);
}

TEST_F(RayCastPass, DrawsOnlyItsViewport)
{
  this->Renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  vtkNew<vtkRenderer> second;
  second->SetViewport(0.5, 0.0, 1.0, 1.0);
  second->SetBackground(1.0, 0.0, 0.0);
  this->Window->AddRenderer(second);
  this->RenderFrames();
  EXPECT_EQ(CountDifferences(
              this->GetPixels(0, Width / 2 - 1), CastRays(this->Renderer, Width / 2, Height)),
    0);
  const Bytes right = this->GetPixels(Width / 2, Width - 1);
  for (std::size_t i = 0; i < right.size(); i += 3)
  {
    ASSERT_EQ(right[i], 255);
    ASSERT_EQ(right[i + 1], 0);
  }
}

TEST_F(RayCastPass, LeavesLayersToWindow)
{
  vtkNew<vtkRenderer> layer;
  vtkSmartPointer<vtkActor> sphere = AddSphere(layer, 0.0);
  sphere->GetProperty()->LightingOff();
  sphere->GetProperty()->SetColor(0.0, 1.0, 0.0);
  layer->SetLayer(1);
  layer->SetViewport(0.7, 0.7, 1.0, 1.0);
  this->Window->SetNumberOfLayers(2);
  this->Window->AddRenderer(layer);
  this->RenderFrames();
  const Bytes pixels = this->GetPixels();
  const Bytes rays = CastRays(this->Renderer, Width, Height);
  const std::size_t center = 3 * (static_cast<std::size_t>(0.85 * Height) * Width + 102);
  EXPECT_EQ(pixels[center + 1], 255);
  EXPECT_EQ(pixels[center], 0);
  EXPECT_TRUE(std::equal(rays.begin(), rays.begin() + rays.size() / 2, pixels.begin()));
}

TEST_F(RayCastPass, WarnsOnceOfSecondRenderer)
{
  this->Renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  vtkNew<vtkRenderer> second;
  SetUpScene(second);
  second->SetViewport(0.5, 0.0, 1.0, 1.0);
  second->SetPass(this->Pass);
  this->Window->AddRenderer(second);
  this->Window->Render();
  this->Window->Render();
  ASSERT_EQ(this->Warnings.size(), 1u);
  EXPECT_NE(this->Warnings[0].find("another renderer"), std::string::npos) << this->Warnings[0];
  const Bytes right = this->GetPixels(Width / 2, Width - 1);
  EXPECT_GT(*std::max_element(right.begin(), right.end()), 150);
  second->SetPass(nullptr);
}

TEST_F(RayCastPass, DrawsSceneInStereoAndDuringSelection)
{
  this->RenderFrames();
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(this->Renderer);
  selector->SetArea(0, 0, Width - 1, Height - 1);
  const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
  EXPECT_GE(selection->GetNumberOfNodes(), 2u);
  EXPECT_TRUE(this->Warnings.empty());
  this->Window->StereoRenderOn();
  this->Window->SetStereoTypeToAnaglyph();
  this->Window->Render();
  EXPECT_EQ(this->Warnings.size(), 1u);
  const Bytes pixels = this->GetPixels();
  EXPECT_GT(*std::max_element(pixels.begin(), pixels.end()), 150);
}

TEST(RayCaster, WarnsOfPassesUnlessItComputesTheirEffects)
{
  const auto collect = [](const auto& addPass, bool occlusion, bool medium) {
    vtkNew<vtkRenderer> renderer;
    SetUpScene(renderer);
    addPass(renderer.Get());
    vtkNew<vtkPenumbraRayCaster> caster;
    caster->SetRenderer(renderer);
    caster->SetResolution(8, 6);
    caster->SetTolerance(1.0);
    caster->SetAmbientOcclusion(occlusion);
    caster->SetMedium(medium ? vtkNew<vtkPenumbraMedium>().Get() : nullptr);
    std::vector<std::string> warnings;
    CollectWarnings(caster, warnings);
    caster->Update();
    return warnings;
  };
  const auto countWarnings = [&](const auto& addPass, bool occlusion, bool medium) {
    return collect(addPass, occlusion, medium).size();
  };
  const auto occlusion = [](
                           vtkRenderer* renderer) { vtkPenumbraTemporalSSAOPass::AddTo(renderer); };
  const auto shafts = [](vtkRenderer* renderer) { vtkPenumbraLightShaftPass::AddTo(renderer); };
  const auto outermost = [](vtkRenderer* renderer) {
    renderer->SetPass(vtkNew<vtkPenumbraTemporalSSAOPass>());
  };
  const auto other = [](vtkRenderer* renderer) { renderer->SetPass(vtkNew<vtkLightsPass>()); };
  EXPECT_EQ(countWarnings(occlusion, false, false), 1u);
  EXPECT_EQ(countWarnings(occlusion, true, false), 0u);
  EXPECT_EQ(countWarnings(shafts, false, true), 0u);
  EXPECT_EQ(countWarnings(outermost, true, false), 0u);
  const auto both = [&](vtkRenderer* renderer) {
    occlusion(renderer);
    shafts(renderer);
  };
  EXPECT_EQ(countWarnings(shafts, true, false), 1u);
  EXPECT_EQ(countWarnings(occlusion, false, true), 1u);
  EXPECT_EQ(countWarnings(outermost, false, true), 1u);
  EXPECT_EQ(countWarnings(both, true, false), 1u);
  EXPECT_EQ(countWarnings(both, false, true), 1u);
  EXPECT_EQ(countWarnings(both, true, true), 0u);
  EXPECT_EQ(countWarnings(other, true, true), 1u);
  const auto names = [&](bool hasOcclusion, bool hasMedium, const std::string& text) {
    const std::vector<std::string> warnings = collect(both, hasOcclusion, hasMedium);
    return warnings.size() == 1 &&
      warnings[0].find("The render pass of the renderer is ignored: " + text) != std::string::npos;
  };
  EXPECT_TRUE(names(false, true,
    "ambient occlusion of its pass is not in the image. Call SetAmbientOcclusion(true)."));
  EXPECT_TRUE(
    names(true, false, "light shafts of its pass are not in the image. Call SetMedium()."));
  EXPECT_TRUE(names(false, false,
    "ambient occlusion and light shafts of its pass are not in the image. Call "
    "SetAmbientOcclusion(true) and SetMedium()."));
}

TEST_F(RayCastPass, RejectsInvalidTimeLimits)
{
  vtkNew<vtkCallbackCommand> ignore;
  this->Pass->AddObserver(vtkCommand::ErrorEvent, ignore);
  this->Pass->SetTimeLimit(std::nan(""));
  EXPECT_EQ(this->Pass->GetTimeLimit(), 0.005);
  this->Pass->SetTimeLimit(-1.0);
  EXPECT_EQ(this->Pass->GetTimeLimit(), 0.001);
}

// A measurement, which is not run by default: the first frame after the camera of a kept scene has moved.
TEST_F(RayCastPass, DISABLED_ShowsPreviewOfMillionTriangles)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(1000);
  sphere->SetPhiResolution(502);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  this->Renderer->RemoveAllViewProps();
  this->Renderer->AddActor(actor);
  this->Window->SetSize(1000, 600);
  this->Pass->SetTimeLimit(0.05);
  for (const bool effects : { false, true })
  {
    this->Pass->GetRayCaster()->SetShadows(effects);
    this->Pass->GetRayCaster()->SetAmbientOcclusion(effects);
    std::cout << (effects ? "shadows and occlusion:" : "plain:");
    for (int i = 0; i < 8; ++i)
    {
      this->Renderer->GetActiveCamera()->Azimuth(3.0);
      const auto start = std::chrono::steady_clock::now();
      const std::clock_t startCPU = std::clock();
      this->Window->Render();
      const std::chrono::duration<double, std::milli> frame =
        std::chrono::steady_clock::now() - start;
      std::cout << " " << std::lround(frame.count()) << " ("
                << std::lround(1e3 * static_cast<double>(std::clock() - startCPU) / CLOCKS_PER_SEC)
                << ")";
    }
    vtkPenumbraRayCaster* caster = this->Pass->GetRayCaster();
    std::cout << " ms (CPU of all threads); estimated error " << caster->GetEstimatedError()
              << "; phases of the last";
    for (int phase = 0; phase < 4; ++phase)
    {
      std::cout << " " << std::lround(1000.0 * caster->GetPhaseSeconds(phase));
    }
    std::cout << " ms; frames until complete " << this->RenderFrames() << "\n";
  }
}

}
