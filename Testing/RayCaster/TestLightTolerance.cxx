// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// LightTolerance of vtkPenumbraRayCaster: which work and which errors it bounds. The reference is a
// closed form: the occlusion of a floor by a sphere.
#include "vtkPenumbraIrradianceProvider.h"
#include "vtkPenumbraRayCaster.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace
{

constexpr int Size = 64;
constexpr double Left = 1.2; // of the view, whose side is 1.6
constexpr double ViewSide = 1.6;
constexpr double Height = 1.3; // of the center of the sphere, whose radius is 1

/// A provider without an estimate of its error.
class ConstantOcclusion : public vtkPenumbraIrradianceProvider
{
public:
  static ConstantOcclusion* New();
  vtkTypeMacro(ConstantOcclusion, vtkPenumbraIrradianceProvider);

  bool Begin(
    const penumbra::RayScene&, const Occluders&, double tolerance, const Progress&) override
  {
    this->Tolerance = tolerance;
    return true;
  }
  Estimate Occlusion(const double*, const double*, const double*) const override
  {
    return { 0.25, 0.0, 0 };
  }
  bool BeginIrradiance(const penumbra::Illumination&, double, const Progress&) override
  {
    return true;
  }
  Light Irradiance(const double*, const double*, double, const double*) const override
  {
    return {};
  }

  double Tolerance = 0.0;
};
vtkStandardNewMacro(ConstantOcclusion);

/// An unlit floor under a sphere that is outside of the view, seen from above.
class LightTolerance : public testing::Test
{
protected:
  void SetUp() override
  {
    vtkNew<vtkPlaneSource> floor;
    floor->SetOrigin(-6.0, -6.0, 0.0);
    floor->SetPoint1(6.0, -6.0, 0.0);
    floor->SetPoint2(-6.0, 6.0, 0.0);
    this->Add(floor)->LightingOff();
    vtkNew<vtkSphereSource> sphere;
    sphere->SetRadius(1.0);
    sphere->SetCenter(0.0, 0.0, Height);
    sphere->SetThetaResolution(150);
    sphere->SetPhiResolution(150);
    this->Add(sphere);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetFocalPoint(Left + 0.5 * ViewSide, 0.0, 0.0);
    camera->SetPosition(Left + 0.5 * ViewSide, 0.0, 10.0);
    camera->ParallelProjectionOn();
    camera->SetParallelScale(0.5 * ViewSide);
    this->Caster->SetRenderer(this->Renderer);
    this->Caster->SetResolution(Size, Size);
    this->Caster->SetAmbientOcclusionRadius(1e4);
    this->Caster->SetAmbientOcclusionStrength(1.0);
    vtkNew<vtkCallbackCommand> observer;
    observer->SetClientData(&this->Messages);
    observer->SetCallback([](vtkObject*, unsigned long, void* data, void* text) {
      *static_cast<std::string*>(data) += static_cast<const char*>(text);
    });
    this->Caster->AddObserver(vtkCommand::WarningEvent, observer);
    this->Caster->AddObserver(vtkCommand::ErrorEvent, observer);
  }

  vtkProperty* Add(vtkPolyDataAlgorithm* source)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->Renderer->AddActor(actor);
    return actor->GetProperty();
  }

  void AddLight()
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPosition(0.0, 0.0, 5.0);
    light->SetFocalPoint(0.0, 0.0, 0.0);
    light->SetPositional(true);
    light->SetConeAngle(180.0);
    this->Renderer->AddLight(light);
    vtkActorCollection* actors = this->Renderer->GetActors();
    actors->InitTraversal();
    actors->GetNextActor()->GetProperty()->LightingOn();
  }

  std::vector<float> Render(const char* array = "Color")
  {
    this->Messages.clear();
    this->Caster->Update();
    auto* values =
      vtkFloatArray::SafeDownCast(this->Caster->GetOutput()->GetPointData()->GetArray(array));
    return values ? std::vector<float>(
                      values->GetPointer(0), values->GetPointer(0) + values->GetNumberOfValues())
                  : std::vector<float>();
  }

  double Count(const char* name)
  {
    return this->Caster->GetStatistics()->GetArray(name)->GetTuple1(0);
  }

  double GetField(const char* name)
  {
    vtkDataArray* array = this->Caster->GetOutput()->GetFieldData()->GetArray(name);
    return array ? array->GetTuple1(0) : std::nan("");
  }

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkPenumbraRayCaster> Caster;
  std::string Messages;
};

/// Returns the largest RMSE of 16 x 16 pixels of the floor.
double FindLargestError(const std::vector<float>& colors)
{
  double squares[16] = {};
  for (int p = 0; p < Size * Size; ++p)
  {
    const double x = Left + ViewSide * (p % Size + 0.5) / Size;
    const double y = ViewSide * (p / Size + 0.5) / Size - 0.5 * ViewSide;
    const double open = 1.0 - Height / std::pow(Height * Height + x * x + y * y, 1.5);
    const double error = colors[4 * p] - open;
    squares[p / Size / 16 * 4 + p % Size / 16] += error * error / 256.0;
  }
  return std::sqrt(*std::max_element(squares, squares + 16));
}

}

TEST_F(LightTolerance, FollowsToleranceUnlessItIsSet)
{
  EXPECT_EQ(this->Caster->GetLightTolerance(), 0.0);
  EXPECT_DOUBLE_EQ(this->Caster->GetEffectiveLightTolerance(), 0.01);
  this->Caster->SetTolerance(0.5);
  EXPECT_DOUBLE_EQ(this->Caster->GetEffectiveLightTolerance(), 1.0);
  this->Caster->SetLightTolerance(0.125);
  EXPECT_DOUBLE_EQ(this->Caster->GetEffectiveLightTolerance(), 0.125);
  this->Caster->SetLightTolerance(1e-30);
  EXPECT_DOUBLE_EQ(this->Caster->GetEffectiveLightTolerance(), 1e-6);
  this->Caster->SetLightTolerance(-1.0);
  EXPECT_EQ(this->Caster->GetLightTolerance(), 0.0);
  this->Caster->SetLightTolerance(std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(this->Caster->GetEffectiveLightTolerance(), 1.0);
  std::ostringstream text;
  this->Caster->Print(text);
  EXPECT_NE(text.str().find("  LightTolerance: 1\n"), std::string::npos);
}

TEST_F(LightTolerance, RejectsNaN)
{
  this->Caster->SetLightTolerance(std::nan(""));
  EXPECT_TRUE(this->Render().empty());
  EXPECT_NE(this->Messages.find("LightTolerance"), std::string::npos) << this->Messages;
}

TEST_F(LightTolerance, ChangesNothingWithoutLightEffects)
{
  this->AddLight();
  this->Caster->ShadowsOn();
  const std::vector<float> colors = this->Render();
  EXPECT_TRUE(this->Render("EstimatedLightError").empty());
  EXPECT_EQ(this->Caster->GetEstimatedLightError(), 0.0);
  const double error = this->Caster->GetEstimatedError();
  this->Caster->SetLightTolerance(0.5);
  EXPECT_EQ(this->Render(), colors);
  EXPECT_EQ(this->Caster->GetEstimatedError(), error);
}

TEST_F(LightTolerance, BoundsTheErrorOfOcclusionByTiles)
{
  this->Caster->AmbientOcclusionOn();
  double rays = std::numeric_limits<double>::infinity();
  for (const double tolerance : { 1.0 / 512.0, 0.01, 0.04 })
  {
    SCOPED_TRACE(tolerance);
    this->Caster->SetLightTolerance(tolerance);
    EXPECT_LE(FindLargestError(this->Render()), tolerance);
    EXPECT_EQ(this->Messages, "");
    EXPECT_LT(this->Count("Rays/Occlusion"), 0.8 * rays);
    rays = this->Count("Rays/Occlusion");
    EXPECT_LE(this->Caster->GetEstimatedLightError(), (1.0 + 1e-6) * tolerance);
    EXPECT_GT(this->Caster->GetEstimatedLightError(), 0.0);
    EXPECT_GE(this->Caster->GetEstimatedError(), this->Caster->GetEstimatedLightError());
  }
  // Tolerance does not change how much light is sampled if LightTolerance is set.
  this->Caster->SetTolerance(1.0 / 64.0);
  this->Render();
  EXPECT_EQ(this->Count("Rays/Occlusion"), rays);
}

TEST_F(LightTolerance, IsInTheFieldDataWithTheEstimates)
{
  this->Caster->AmbientOcclusionOn();
  const std::vector<float> light = this->Render("EstimatedLightError");
  EXPECT_DOUBLE_EQ(this->GetField("Tolerance"), 1.0 / 256.0);
  EXPECT_DOUBLE_EQ(this->GetField("LightTolerance"), 0.01);
  EXPECT_EQ(this->GetField("EstimatedError"), this->Caster->GetEstimatedError());
  EXPECT_EQ(this->GetField("EstimatedLightError"), this->Caster->GetEstimatedLightError());
  double squares = 0.0;
  for (const float error : light)
  {
    squares += static_cast<double>(error) * error;
  }
  EXPECT_NEAR(std::sqrt(squares / (Size * Size)), this->Caster->GetEstimatedLightError(), 1e-9);
}

TEST_F(LightTolerance, IsPassedToProvidersWithoutAnEstimate)
{
  const vtkNew<ConstantOcclusion> provider;
  this->Caster->SetIrradianceProvider(provider);
  this->Caster->AmbientOcclusionOn();
  this->Caster->SetLightTolerance(0.03);
  for (const float color : this->Render())
  {
    EXPECT_TRUE(color == 0.75f || color == 1.f) << color;
  }
  EXPECT_EQ(this->Messages, "");
  EXPECT_DOUBLE_EQ(provider->Tolerance, 0.06); // of one of about four samples per pixel
}

TEST_F(LightTolerance, HoldsInAnImageOfOnePixel)
{
  this->Caster->AmbientOcclusionOn();
  this->Caster->SetResolution(1, 1);
  double sum = 0.0;
  constexpr int Samples = 256;
  for (int i = 0; i < Samples * Samples; ++i)
  {
    const double x = Left + ViewSide * (i % Samples + 0.5) / Samples;
    const double y = ViewSide * (i / Samples + 0.5) / Samples - 0.5 * ViewSide;
    sum += 1.0 - Height / std::pow(Height * Height + x * x + y * y, 1.5);
  }
  EXPECT_NEAR(this->Render()[0], sum / (Samples * Samples), 0.02);
}

TEST_F(LightTolerance, HoldsInARegionFarFromTheRest)
{
  this->Caster->AmbientOcclusionOn();
  const std::vector<float> whole = this->Render();
  this->Caster->Modified();
  int extent[6] = { 0, 0, 0, 0, 0, 0 };
  this->Caster->UpdateExtent(extent);
  int last[6] = { Size - 1, Size - 1, Size - 1, Size - 1, 0, 0 };
  this->Caster->UpdateExtent(last);
  auto* color =
    vtkFloatArray::SafeDownCast(this->Caster->GetOutput()->GetPointData()->GetArray("Color"));
  ASSERT_EQ(color->GetNumberOfTuples(), 1);
  EXPECT_EQ(color->GetValue(0), whole[whole.size() - 4]);
}
