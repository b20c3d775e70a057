// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// TimeLimit of vtkPenumbraRayCaster. No test depends on the speed of the machine: a limit of a nanosecond
// is always reached, one of many years never, and the limit of RegionRenderer counts its calls.
#include "Scenes/TestScene.h"

#include "Embree/RayScene.h"
#include "Image/RegionRenderer.h"
#include "Import/SceneExtraction.h"
#include "Light/LightRays.h"
#include "Scene.h"
#include "Shading/Shading.h"
#include "Surface.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

using namespace penumbra;

namespace
{

constexpr int Width = 120;
constexpr int Height = 90;
constexpr double ShortLimit = 1e-9;
constexpr double LongLimit = 1e12;

/// Bumpy spheres on a floor.
vtkSmartPointer<vtkRenderer> MakeSpheres()
{
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  const vtkSmartPointer<vtkPolyData> burr = Burr();
  for (int i = 0; i < 3; ++i)
  {
    AddMesh(renderer, burr, true)->SetPosition(1.1 * (i - 1), 0.1 * i, 0.5);
  }
  vtkNew<vtkPlaneSource> floor;
  floor->SetOrigin(-30.0, -30.0, 0.0);
  floor->SetPoint1(30.0, -30.0, 0.0);
  floor->SetPoint2(-30.0, 30.0, 0.0);
  floor->Update();
  AddMesh(renderer, floor->GetOutput(), true);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(0.0, -6.0, 3.6);
  camera->SetFocalPoint(0.0, 0.0, 0.3);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(30.0);
  return renderer;
}

/// Effects of an image.
enum Effects
{
  None = 0,
  Occlusion = 1,
  SoftShadows = 2,
  Indirect = 4,
  Translucent = 8,
};

void CollectWarning(vtkObject*, unsigned long, void* clientData, void* callData)
{
  static_cast<std::vector<std::string>*>(clientData)->push_back(static_cast<char*>(callData));
}

/// An image of MakeSpheres().
struct LimitedImage
{
  vtkNew<vtkPenumbraRayCaster> Caster;
  std::vector<std::string> Warnings;

  LimitedImage(int effects, double seconds)
  {
    const vtkSmartPointer<vtkRenderer> renderer = MakeSpheres();
    if (effects & Translucent)
    {
      // VTK 9.2 fills the collection again in each call of GetActors().
      vtkActorCollection* actors = renderer->GetActors();
      vtkProperty* property = static_cast<vtkActor*>(actors->GetItemAsObject(0))->GetProperty();
      property->SetOpacity(0.5);
      property->EdgeVisibilityOn();
    }
    this->Caster->SetRenderer(renderer);
    this->Caster->SetResolution(Width, Height);
    this->Caster->SetTimeLimit(seconds);
    this->Caster->SetAmbientOcclusion(effects & Occlusion);
    this->Caster->SetAmbientOcclusionRadius(1.0);
    this->Caster->SetIndirectLight(effects & Indirect);
    this->Caster->SetEnvironmentColor(0.5, 0.5, 0.5);
    this->Caster->SetBounces(1);
    this->Caster->SetLightTolerance(effects & Indirect ? 0.1 : 0.0);
    if (effects & SoftShadows)
    {
      vtkNew<vtkLight> light;
      light->PositionalOff();
      light->SetPosition(2.0, -1.0, 4.0);
      renderer->AddLight(light);
      this->Caster->ShadowsOn();
      this->Caster->SetLightAngle(10.0);
    }
    vtkNew<vtkCallbackCommand> observer;
    observer->SetCallback(CollectWarning);
    observer->SetClientData(&this->Warnings);
    this->Caster->AddObserver(vtkCommand::WarningEvent, observer);
    this->Caster->Update();
  }

  std::vector<float> GetArray(const char* name)
  {
    auto* array =
      vtkFloatArray::SafeDownCast(this->Caster->GetOutput()->GetPointData()->GetArray(name));
    return array
      ? std::vector<float>(array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues())
      : std::vector<float>();
  }
  double GetStatistic(const char* name)
  {
    return this->Caster->GetStatistics()->GetArray(name)->GetComponent(0, 0);
  }
};

double ComputeRMSE(const std::vector<float>& a, const std::vector<float>& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += i % 4 < 3 ? (a[i] - b[i]) * (a[i] - b[i]) : 0.0;
  }
  return std::sqrt(sum / (0.75 * static_cast<double>(a.size())));
}

class TimeLimitWithEffects : public testing::TestWithParam<int>
{
};

INSTANTIATE_TEST_SUITE_P(TimeLimit, TimeLimitWithEffects,
  testing::Values(None, Occlusion, SoftShadows, Occlusion | SoftShadows, Indirect, Translucent));

TEST_P(TimeLimitWithEffects, LeavesCompleteImageWithItsError)
{
  LimitedImage full(this->GetParam(), 0.0);
  LimitedImage limited(this->GetParam(), ShortLimit);
  const std::vector<float> colors = limited.GetArray("Color");
  ASSERT_EQ(colors.size(), 4u * Width * Height);
  EXPECT_TRUE(std::all_of(colors.begin(), colors.end(), [](float c) { return std::isfinite(c); }));
  for (std::size_t i = 3; i < colors.size(); i += 4)
  {
    EXPECT_EQ(colors[i], 1.f);
  }
  const double error = ComputeRMSE(colors, full.GetArray("Color"));
  const double estimate = limited.Caster->GetEstimatedError();
  RecordProperty("RMSE", std::to_string(error));
  RecordProperty("Estimate", std::to_string(estimate));
  EXPECT_LT(error, 2.0 * estimate);
  EXPECT_LT(estimate, 0.2);
  EXPECT_LT(estimate, 6.0 * error);
  EXPECT_EQ(limited.GetStatistic("TimeLimit/Reached"), 1.0);
  EXPECT_EQ(limited.GetStatistic("Pixels/Unfinished"), Width * Height);
  EXPECT_GT(limited.GetStatistic("Tiles/AboveTolerance"), 10.0);
}

TEST_P(TimeLimitWithEffects, ChangesNothingUnlessReached)
{
  LimitedImage full(this->GetParam(), 0.0);
  LimitedImage limited(this->GetParam(), LongLimit);
  for (const char* name : { "Color", "EstimatedError", "EstimatedLightError", "Rays" })
  {
    EXPECT_EQ(full.GetArray(name), limited.GetArray(name)) << name;
  }
  EXPECT_EQ(limited.GetStatistic("TimeLimit/Reached"), 0.0);
  EXPECT_EQ(limited.GetStatistic("Pixels/Unfinished"), 0.0);
  EXPECT_EQ(full.GetStatistic("Rays/PerPixel"), limited.GetStatistic("Rays/PerPixel"));
}

TEST(TimeLimit, IsReportedByOneWarning)
{
  LimitedImage limited(Occlusion, ShortLimit);
  ASSERT_EQ(limited.Warnings.size(), 1u);
  EXPECT_NE(limited.Warnings[0].find("The time limit of 1e-09 s ended the work. The tolerance of"),
    std::string::npos)
    << limited.Warnings[0];
  EXPECT_NE(limited.Warnings[0].find("Increase TimeLimit."), std::string::npos);
}

TEST(TimeLimit, RejectsInvalidNumbers)
{
  for (const double seconds : { -1.0, std::numeric_limits<double>::quiet_NaN() })
  {
    vtkNew<vtkPenumbraRayCaster> caster;
    std::vector<std::string> errors;
    vtkNew<vtkCallbackCommand> observer;
    observer->SetCallback(CollectWarning);
    observer->SetClientData(&errors);
    caster->AddObserver(vtkCommand::ErrorEvent, observer);
    caster->SetTimeLimit(seconds);
    caster->Update();
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_NE(errors[0].find("TimeLimit must be"), std::string::npos) << errors[0];
  }
}

TEST(TimeLimit, DoesNotAffectKeptScenes)
{
  LimitedImage image(None, 0.0);
  image.Caster->GetRenderer()->GetActiveCamera()->SetPosition(0.0, -90.0, 60.0);
  image.Caster->KeepSceneOn();
  image.Caster->Update();
  image.Caster->SetTimeLimit(LongLimit);
  image.Caster->Update();
  EXPECT_EQ(image.GetStatistic("Scene/Extractions"), 0.0);
}

/// The stages of an image with a limit after a number of calls.
class Stages
{
public:
  explicit Stages(bool occlusion)
    : Renderer(MakeSpheres()),
      Extracted(Extract(this->Renderer)),
      Rays(this->Extracted, 1),
      Lit(this->Rays, false),
      Tracer(this->Rays, this->Lit, this->Extracted.ViewCamera)
  {
    if (occlusion)
    {
      auto effects = std::make_shared<LightEffects>();
      effects->Tolerance = 0.01;
      effects->Occlusion.emplace(
        this->Rays, DistanceFalloff::InScene(1.0, 0, this->Extracted.Scale), effects->Tolerance);
      this->Settings.Light = effects;
      this->Tracer.SetLayerLight(true, 1.0);
    }
    this->Edges = FindSceneEdges(this->Extracted, this->Settings);
  }

  /// Renders with a limit that is reached after each `calls` calls, until the image is complete.
  ImageRegion RenderInParts(int calls, int& parts)
  {
    std::atomic<int> count{ 0 };
    WorkLimit limit([&](double) { return ++count > calls; });
    RenderSettings settings = this->Settings;
    settings.Limit = &limit;
    RegionRenderer renderer(
      this->Tracer, this->Edges, settings, glm::ivec2(0), glm::ivec2(Width, Height));
    for (parts = 1; !renderer.Run({}); ++parts)
    {
      EXPECT_GT(renderer.CopyResult().Colors[0].a, 0.f);
      count = 0;
      limit.BeginPart(1.0);
    }
    return renderer.TakeResult();
  }

  /// Renders until a limit is reached that also interrupts tiles.
  ImageRegion RenderPart(int calls)
  {
    std::atomic<int> count{ 0 };
    WorkLimit limit([&](double) { return ++count > calls; });
    RenderSettings settings = this->Settings;
    settings.Limit = &limit;
    settings.Integration.Limit = &limit;
    ImageRegion region;
    region.High = { Width, Height };
    EXPECT_TRUE(RenderRegion(this->Tracer, this->Edges, settings, {}, region));
    return region;
  }

  ImageRegion RenderAll()
  {
    ImageRegion region;
    region.High = { Width, Height };
    EXPECT_TRUE(RenderRegion(this->Tracer, this->Edges, this->Settings, {}, region));
    return region;
  }

private:
  static Scene Extract(vtkRenderer* renderer)
  {
    ExtractionOptions options;
    options.Resolution[0] = Width;
    options.Resolution[1] = Height;
    return ExtractScene(renderer, options);
  }

  vtkSmartPointer<vtkRenderer> Renderer;
  Scene Extracted;
  RayScene Rays;
  Shading Lit;
  CameraRayTracer Tracer;
  RenderSettings Settings;
  SceneEdges Edges;
};

std::vector<float> Flatten(const ImageRegion& region)
{
  return { &region.Colors[0].x, &region.Colors[0].x + 4 * region.Colors.size() };
}

double ComputeEstimate(const ImageRegion& region)
{
  double sum = 0.0;
  for (const float error : region.Errors)
  {
    sum += error * error;
  }
  return std::sqrt(sum / static_cast<double>(region.Errors.size()));
}

TEST(TimeLimit, ContinuesToSameBits)
{
  for (const bool occlusion : { false, true })
  {
    Stages stages(occlusion);
    const ImageRegion full = stages.RenderAll();
    for (const int calls : occlusion ? std::vector<int>{ 17 } : std::vector<int>{ 3, 17 })
    {
      int parts = 0;
      const ImageRegion region = stages.RenderInParts(calls, parts);
      EXPECT_GE(parts, 3);
      EXPECT_EQ(Flatten(region), Flatten(full)) << occlusion << " " << calls;
      EXPECT_EQ(region.Errors, full.Errors);
      EXPECT_EQ(region.Unfinished, 0);
    }
  }
}

TEST(TimeLimit, LeavesSmallerErrorsWithMoreWork)
{
  for (const bool occlusion : { false, true })
  {
    Stages stages(occlusion);
    const std::vector<float> full = Flatten(stages.RenderAll());
    double before = 1.0;
    for (int calls = 1; calls < 100000; calls *= 4)
    {
      const ImageRegion region = stages.RenderPart(calls);
      const double error = ComputeRMSE(Flatten(region), full);
      const double estimate = ComputeEstimate(region);
      EXPECT_LE(error, 2.0 * estimate) << calls;
      EXPECT_LE(error, 1.1 * before) << calls;
      before = std::max(error, 1e-6);
    }
    EXPECT_LT(before, 1e-3);
  }
}

}
