// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraMedium.h"

#include "ClosedForms/HalfPlaneScattering.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"

#include "vtkActor.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace
{

constexpr int Width = 48;
constexpr int Height = 36;
constexpr double Infinity = std::numeric_limits<double>::infinity();

void CountWarning(vtkObject*, unsigned long, void* clientData, void*)
{
  ++*static_cast<int*>(clientData);
}

class MediumTest : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->Haze.Intensity = 8.0;
    this->Light = this->Haze.AddTo(this->Renderer);
    this->Haze.Describe(this->Medium);
    this->Caster->SetRenderer(this->Renderer);
    this->Caster->SetResolution(Width, Height);
    this->Caster->SetMedium(this->Medium);
    vtkNew<vtkCallbackCommand> observer;
    observer->SetCallback(CountWarning);
    observer->SetClientData(&this->Warnings);
    this->Caster->AddObserver(vtkCommand::WarningEvent, observer);
  }

  std::vector<float> Render()
  {
    this->Caster->UpdateWholeExtent();
    auto* color =
      vtkFloatArray::SafeDownCast(this->Caster->GetOutput()->GetPointData()->GetArray("Color"));
    return { color->GetPointer(0), color->GetPointer(0) + color->GetNumberOfValues() };
  }

  /// Adds a white wall at `x`, across the view.
  vtkProperty* AddWall(double x)
  {
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(x, -50.0, -50.0);
    plane->SetPoint1(x, 50.0, -50.0);
    plane->SetPoint2(x, -50.0, 50.0);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(plane->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->Renderer->AddActor(actor);
    return actor->GetProperty();
  }

  /// Replaces all props by a wall, x = 5, in the medium between x = -2 and 5.
  void ReplaceProps()
  {
    this->Renderer->RemoveAllViewProps();
    this->AddWall(5.0);
    this->Medium->SetBounds(-2.0, 5.0, -1000.0, 1000.0, -1000.0, 1000.0);
  }

  double Statistic(const char* name)
  {
    return this->Caster->GetStatistics()->GetArray(name)->GetTuple1(0);
  }

  /// Returns the closed form along the ray through image point (x, y).
  double Exact(double x, double y) const
  {
    return this->Haze.Exact(
      (x - 0.5 * Width) / (0.5 * Height), (y - 0.5 * Height) / (0.5 * Height));
  }

  penumbra::HalfPlaneInHaze Haze;
  vtkNew<vtkRenderer> Renderer;
  vtkLight* Light = nullptr;
  vtkNew<vtkPenumbraMedium> Medium;
  vtkNew<vtkPenumbraRayCaster> Caster;
  int Warnings = 0;
};

}

TEST_F(MediumTest, MatchesTheClosedForm)
{
  for (const int steps : { 0, 64 })
  {
    this->Caster->GetConstants().LightShaftSteps = steps;
    const std::vector<float> image = this->Render();
    double squares = 0.0;
    double reference = 0.0;
    for (int y = 0; y < Height; ++y)
    {
      for (int x = 0; x < Width; ++x)
      {
        double exact = 0.0;
        for (int k = 0; k < 64; ++k)
        {
          exact += this->Exact(x + (k % 8 + 0.5) / 8.0, y + (k / 8 + 0.5) / 8.0) / 64.0;
        }
        const double error = image[4 * (y * Width + x)] - exact;
        squares += error * error;
        reference += exact * exact;
      }
    }
    EXPECT_LT(std::sqrt(squares / reference), 0.005) << steps;
    EXPECT_GT(this->Statistic("Rays/Shaft"), 0.0);
    EXPECT_GT(this->Caster->GetEstimatedError(), std::sqrt(squares / (Width * Height)));
  }
}

TEST_F(MediumTest, IsNotLitByCameraLightsWithoutCameraLightShafts)
{
  const std::vector<float> alone = this->Render();
  vtkNew<vtkLight> cameraLight;
  cameraLight->SetLightTypeToCameraLight();
  cameraLight->SetPosition(1.0, 1.0, 1.0);
  this->Renderer->AddLight(cameraLight);
  EXPECT_NE(this->Render(), alone);
  this->Caster->GetConstants().CameraLightShafts = false;
  this->Caster->Modified();
  EXPECT_EQ(this->Render(), alone);
  this->Renderer->RemoveLight(this->Light);
  this->Render();
  EXPECT_EQ(this->Warnings, 1); // No light is left.
}

TEST_F(MediumTest, AttenuatesTheBackground)
{
  // The light is negligible. The path through the medium has a length of 6.3.
  this->Renderer->SetBackground(1.0, 0.5, 0.25);
  this->Light->SetIntensity(1e-30);
  this->Medium->SetBounds(-2.0, 5.0, -1000.0, 1000.0, -1000.0, 1000.0);
  const std::vector<float> image = this->Render();
  const int center = 4 * (Height / 2 * Width + Width / 2) - 4 * Width;
  EXPECT_NEAR(image[center], std::exp(-0.5 * 6.3), 2e-3);
  EXPECT_NEAR(image[center + 1], 0.5 * image[center], 1e-6);
  EXPECT_NEAR(image[center + 3], 1.0, 1e-6);
}

TEST_F(MediumTest, AttenuatesEachChannelOfTheBackground)
{
  this->Renderer->SetBackground(1.0, 1.0, 1.0);
  this->Light->SetIntensity(1e-30);
  this->Medium->SetScattering(0.1);
  this->Medium->SetExtinction(0.3);
  this->Medium->SetExtinctionColor(1.0, 0.5, 2.0);
  this->Medium->SetRayleighScattering(0.05);
  this->Medium->SetBounds(-2.0, 5.0, -1000.0, 1000.0, -1000.0, 1000.0);
  const std::vector<float> image = this->Render();
  const float* center = &image[4 * (Height / 2 * Width + Width / 2) - 4 * Width];
  const double factors[] = { std::pow(550.0 / 680.0, 4.0), 1.0, std::pow(550.0 / 440.0, 4.0) };
  const double extinctions[] = { 0.3, 0.15, 0.6 };
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(center[i], std::exp(-(extinctions[i] + 0.05 * factors[i]) * 6.3), 2e-3);
  }
  EXPECT_NEAR(center[3], 1.0, 1e-6);
}

TEST_F(MediumTest, AttenuatesReflectedSkyLight)
{
  // A wall that reflects half the light of a white sky, at a distance of 6.3.
  this->ReplaceProps();
  this->Light->SetIntensity(1e-30);
  this->Medium->SetScattering(0.1);
  this->Medium->SetExtinction(0.3);
  this->Medium->SetExtinctionColor(1.0, 0.5, 2.0);
  this->Caster->IndirectLightOn();
  this->Caster->SetEnvironmentColor(1.0, 1.0, 1.0);
  this->Caster->SetAlbedo(0.5);
  const std::vector<float> image = this->Render();
  const float* center = &image[4 * (Height / 2 * Width + Width / 2)];
  const double extinctions[] = { 0.3, 0.15, 0.6 };
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(center[i], 0.5 * std::exp(-extinctions[i] * 6.3), 2e-3);
  }
}

TEST_F(MediumTest, JoinedPixelsAgreeWithEstimatesAtEachPoint)
{
  this->ReplaceProps();
  vtkNew<vtkSphereSource> ball;
  ball->SetCenter(3.5, 0.2, 0.1);
  ball->SetRadius(0.8);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(ball->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(1.0, 0.6, 0.3);
  this->Renderer->AddActor(actor);
  this->Light->SetIntensity(10.0);
  this->Medium->SetScattering(0.2);
  this->Medium->SetExtinction(0.2);
  this->Caster->IndirectLightOn();
  this->Caster->AmbientOcclusionOn();
  this->Caster->SetEnvironmentColor(0.4, 0.6, 0.9);
  this->Caster->SetTolerance(1.0 / 512.0);
  this->Caster->SetLightTolerance(0.005);
  const std::vector<float> joined = this->Render();
  EXPECT_EQ(this->Warnings, 0);
  const std::vector<float> withoutJoining = [&] {
    vtkNew<vtkPenumbraBruteForceIrradiance> points;
    points->JoinPixelsOff();
    this->Caster->SetIrradianceProvider(points);
    return this->Render();
  }();
  double squares = 0.0;
  double sums[3] = {};
  for (int p = 0; p < Width * Height; ++p)
  {
    for (int i = 0; i < 3; ++i)
    {
      const double difference = joined[4 * p + i] - withoutJoining[4 * p + i];
      squares += difference * difference / 3.0;
      sums[i] += difference;
    }
  }
  EXPECT_LT(std::sqrt(squares / (Width * Height)), 0.005);
  for (const double sum : sums)
  {
    EXPECT_NEAR(sum / (Width * Height), 0.0, 0.001);
  }
}

TEST_F(MediumTest, AttenuatesLightOnItsWayToSurfaces)
{
  // A white floor, z = -1, that the sun reaches through a fall-off: optical depth 1.5 in green.
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-50.0, -50.0, -1.0);
  plane->SetPoint1(50.0, -50.0, -1.0);
  plane->SetPoint2(-50.0, 50.0, -1.0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  this->Renderer->RemoveAllViewProps();
  this->Renderer->AddActor(actor);
  this->Light->SetIntensity(1.0);
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(0.0, 0.0, -0.99);
  camera->SetFocalPoint(0.0, 0.0, -1.0);
  camera->SetViewUp(0.0, 1.0, 0.0);
  this->Medium->SetBounds(-Infinity, Infinity, -Infinity, Infinity, -Infinity, Infinity);
  this->Medium->SetScattering(0.0);
  this->Medium->SetExtinction(0.5);
  this->Medium->SetExtinctionColor(0.5, 1.0, 1.5);
  this->Medium->SetScaleHeight(3.0);
  this->Medium->SetBaseHeight(-1.0);
  this->Medium->SetUp(0.0, 0.0, 2.0);
  const std::vector<float> image = this->Render();
  const float* center = &image[4 * (Height / 2 * Width + Width / 2)];
  for (int i = 0; i < 3; ++i)
  {
    const double depth = 0.75 * (i + 1);
    EXPECT_NEAR(center[i], std::exp(-depth - depth / 3.0 * 0.01), 2e-3);
  }
  this->Medium->SetSurfaceLight(vtkPenumbraMedium::UNATTENUATED);
  EXPECT_NEAR(this->Render()[4 * (Height / 2 * Width + Width / 2) + 1], 1.0, 1e-2);
}

TEST_F(MediumTest, KeepsTranslucentSurfacesInFrontIfAsked)
{
  this->Renderer->SetBackground(1.0, 1.0, 1.0);
  this->Light->SetIntensity(1e-30);
  this->Medium->SetBounds(-1.0, 5.0, -1000.0, 1000.0, -1000.0, 1000.0);
  vtkProperty* const pane = this->AddWall(0.7);
  pane->LightingOff();
  pane->SetOpacity(0.5);
  const int center = 4 * (Height / 2 * Width + Width / 2) - 4 * Width;
  const double toPane = std::exp(-0.5 * 1.7);
  const double through = std::exp(-0.5 * 6.0);
  EXPECT_NEAR(this->Render()[center], 0.5 * toPane + 0.5 * through, 2e-3);
  this->Medium->TranslucentSurfacesOff();
  EXPECT_NEAR(this->Render()[center], 0.5 + 0.5 * through, 2e-3);
}

TEST_F(MediumTest, IsIgnoredWithOneWarningIfTheDensityIsInvalid)
{
  EXPECT_EQ(vtkPenumbraMedium::FindInvalidDensity(vtkNew<vtkPolyData>()),
    "is a vtkPolyData, not a vtkImageData");
  vtkNew<vtkImageData> density;
  density->SetDimensions(2, 2, 2);
  EXPECT_EQ(vtkPenumbraMedium::FindInvalidDensity(density), "has no point scalars");
  density->AllocateScalars(VTK_FLOAT, 2);
  EXPECT_NE(vtkPenumbraMedium::FindInvalidDensity(density).find("2 components"), std::string::npos);
  density->AllocateScalars(VTK_FLOAT, 1);
  density->GetPointData()->GetScalars()->Fill(1.0);
  EXPECT_EQ(vtkPenumbraMedium::FindInvalidDensity(density), "");
  density->GetPointData()->GetScalars()->SetComponent(3, 0, -1.0);
  this->Medium->SetDensity(density);
  this->Render();
  EXPECT_EQ(this->Warnings, 1);
  this->Medium->SetDensity(nullptr);
  for (const auto set : { +[](vtkPenumbraMedium* medium) { medium->SetScatteringColor(1, -1, 1); },
         +[](vtkPenumbraMedium* medium) { medium->SetRayleighScattering(-1.0); },
         +[](vtkPenumbraMedium* medium) { medium->SetScaleHeight(std::nan("")); } })
  {
    vtkNew<vtkPenumbraMedium> medium;
    set(medium);
    this->Warnings = 0;
    this->Caster->SetMedium(medium);
    this->Render();
    EXPECT_EQ(this->Warnings, 1);
  }
}

TEST_F(MediumTest, IsIndependentOfThreadCountAndExtent)
{
  this->Caster->IndirectLightOn();
  this->Caster->SetNumberOfThreads(1);
  const std::vector<float> one = this->Render();
  this->Caster->SetNumberOfThreads(3);
  EXPECT_EQ(one, this->Render());
  int extent[6] = { 20, 40, 7, 30, 0, 0 };
  this->Caster->Modified();
  this->Caster->UpdateExtent(extent);
  auto* color =
    vtkFloatArray::SafeDownCast(this->Caster->GetOutput()->GetPointData()->GetArray("Color"));
  for (int y = 7; y <= 30; ++y)
  {
    for (int x = 20; x <= 40; ++x)
    {
      const int pixel = (y - 7) * 21 + x - 20;
      ASSERT_EQ(color->GetTypedComponent(pixel, 0), one[4 * (y * Width + x)]);
    }
  }
}

TEST_F(MediumTest, IsIgnoredWithOneWarningIfInvalid)
{
  this->Renderer->SetBackground(0.2, 0.4, 0.6);
  this->Caster->SetMedium(nullptr);
  const std::vector<float> plain = this->Render();
  this->Caster->SetMedium(this->Medium);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double bad[][3] = { { nan, 1.0, 0.0 }, { 1.0, nan, 0.0 },
    { std::numeric_limits<double>::infinity(), 1.0, 0.0 }, { 1.0, 1.0, nan } };
  for (const auto& coefficients : bad)
  {
    this->Warnings = 0;
    this->Medium->SetScattering(coefficients[0]);
    this->Medium->SetExtinction(coefficients[1]);
    this->Medium->SetAsymmetry(coefficients[2]);
    EXPECT_EQ(plain, this->Render());
    EXPECT_EQ(this->Warnings, 1);
  }
  this->Medium->SetScattering(0.3);
  this->Medium->SetExtinction(0.3);
  this->Medium->SetAsymmetry(0.0);
  this->Medium->SetBounds(1.0, 0.0, 0.0, 1.0, 0.0, 1.0);
  this->Warnings = 0;
  EXPECT_EQ(plain, this->Render());
  EXPECT_EQ(this->Warnings, 1);

  this->Medium->SetBounds(0.0, 1.0, 0.0, 1.0, 0.0, 1.0);
  this->Light->SetIntensity(0.0);
  this->Warnings = 0;
  EXPECT_EQ(plain, this->Render());
  EXPECT_EQ(this->Warnings, 1);
}

TEST(MediumSettings, NameTheirEnumerators)
{
  vtkNew<vtkPenumbraMedium> medium;
  EXPECT_STREQ(medium->GetPhaseAsString(), "Isotropic");
  medium->SetPhaseToHenyeyGreenstein();
  EXPECT_EQ(medium->GetPhase(), vtkPenumbraMedium::HENYEY_GREENSTEIN);
  EXPECT_STREQ(medium->GetPhaseAsString(), "HenyeyGreenstein");
  medium->SetSurfaceLightToUnattenuated();
  EXPECT_EQ(medium->GetSurfaceLight(), vtkPenumbraMedium::UNATTENUATED);
  EXPECT_STREQ(medium->GetSurfaceLightAsString(), "Unattenuated");
  vtkNew<vtkPenumbraRayCaster> caster;
  EXPECT_STREQ(caster->GetAmbientOcclusionFalloffAsString(), "None");
  caster->SetAmbientOcclusionFalloffToSquareRoot();
  EXPECT_EQ(caster->GetAmbientOcclusionFalloff(), vtkPenumbraIrradianceProvider::SQUARE_ROOT);
  EXPECT_STREQ(caster->GetAmbientOcclusionFalloffAsString(), "SquareRoot");
}
