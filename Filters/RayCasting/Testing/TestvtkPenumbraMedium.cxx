// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraMedium.h"

#include "ClosedForms/HalfPlaneScattering.h"
#include "vtkPenumbraRayCaster.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace
{

constexpr int Width = 48;
constexpr int Height = 36;

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
    this->Caster->SetLightShaftSteps(steps);
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

TEST_F(MediumTest, IsIndependentOfThreadCountAndExtent)
{
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
