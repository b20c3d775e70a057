// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPenumbraMedium.h"
#include "vtkPenumbraRayCaster.h"

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
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace
{

constexpr double Pi = 3.14159265358979324;
constexpr int Width = 48;
constexpr int Height = 36;

void CountWarning(vtkObject*, unsigned long, void* clientData, void*)
{
  ++*static_cast<int*>(clientData);
}

/// The half-plane x < 0, z = 1 (large), black, under a sun straight above; the eye looks along +x from
/// (-1.3, 0, -0.5).
class MediumTest : public ::testing::Test
{
protected:
  void SetUp() override
  {
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(-1000.0, -1000.0, 1.0);
    plane->SetPoint1(0.0, -1000.0, 1.0);
    plane->SetPoint2(-1000.0, 1000.0, 1.0);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(plane->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetColor(0.0, 0.0, 0.0);
    this->Renderer->AddActor(actor);
    this->Renderer->SetBackground(0.0, 0.0, 0.0);
    this->Renderer->GetActiveCamera()->SetPosition(-1.3, 0.0, -0.5);
    this->Renderer->GetActiveCamera()->SetFocalPoint(0.0, 0.0, -0.5);
    this->Renderer->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
    this->Renderer->GetActiveCamera()->SetViewAngle(90.0);
    this->Sun->SetPosition(0.0, 0.0, 1.0);
    this->Sun->SetFocalPoint(0.0, 0.0, 0.0);
    this->Sun->SetIntensity(8.0);
    this->Renderer->AddLight(this->Sun);
    this->Medium->SetScattering(0.3);
    this->Medium->SetExtinction(0.5);
    const double far = std::numeric_limits<double>::infinity();
    this->Medium->SetBounds(-far, far, -far, far, -far, 2.0);
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

  /// The closed form through picture point (x, y).
  static double Exact(double x, double y)
  {
    const double side = (x - 0.5 * Width) / (0.5 * Height);
    const double up = (y - 0.5 * Height) / (0.5 * Height);
    const double length = std::sqrt(1.0 + side * side + up * up);
    const double slope = up / length;
    const double near = 1.3 * length;
    // Upwards the ray ends at the top of the medium, or at the half-plane.
    const double hit = up > 0.0 ? 1.5 / slope : 1e30;
    const double far = hit < near ? near : up > 0.0 ? 2.5 / slope : 1e30;
    const double a = 0.5 * 2.5;
    const double b = 0.5 * (1.0 - slope);
    return 8.0 * 0.3 / (4.0 * Pi) * std::exp(-a) * (std::exp(-b * near) - std::exp(-b * far)) / b;
  }

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkLight> Sun;
  vtkNew<vtkPenumbraMedium> Medium;
  vtkNew<vtkPenumbraRayCaster> Caster;
  int Warnings = 0;
};

}

TEST_F(MediumTest, MakesThePictureOfTheClosedForm)
{
  for (const int steps : { 0, 64 })
  {
    this->Caster->SetLightShaftSteps(steps);
    const std::vector<float> picture = this->Render();
    double squares = 0.0;
    double reference = 0.0;
    for (int y = 0; y < Height; ++y)
    {
      for (int x = 0; x < Width; ++x)
      {
        double exact = 0.0;
        for (int k = 0; k < 64; ++k)
        {
          exact += Exact(x + (k % 8 + 0.5) / 8.0, y + (k / 8 + 0.5) / 8.0) / 64.0;
        }
        const double error = picture[4 * (y * Width + x)] - exact;
        squares += error * error;
        reference += exact * exact;
      }
    }
    EXPECT_LT(std::sqrt(squares / reference), 0.005) << steps;
    EXPECT_GT(this->Statistic("Rays/Shaft"), 0.0);
    EXPECT_GT(this->Caster->GetEstimatedError(), std::sqrt(squares / (Width * Height)));
  }
}

TEST_F(MediumTest, TakesLightFromWhatLiesBehind)
{
  // All but no light, and 6.3 units of fog before the sky.
  this->Renderer->SetBackground(1.0, 0.5, 0.25);
  this->Sun->SetIntensity(1e-30);
  this->Medium->SetBounds(-2.0, 5.0, -1000.0, 1000.0, -1000.0, 1000.0);
  const std::vector<float> picture = this->Render();
  const int middle = 4 * (Height / 2 * Width + Width / 2) - 4 * Width;
  EXPECT_NEAR(picture[middle], std::exp(-0.5 * 6.3), 2e-3);
  EXPECT_NEAR(picture[middle + 1], 0.5 * picture[middle], 1e-6);
  EXPECT_NEAR(picture[middle + 3], 1.0, 1e-6);
}

TEST_F(MediumTest, HasTheSameBitsForAnyThreadsAndTiles)
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
      const int part = (y - 7) * 21 + x - 20;
      ASSERT_EQ(color->GetTypedComponent(part, 0), one[4 * (y * Width + x)]);
    }
  }
}

TEST_F(MediumTest, LeavesThePictureAloneOnBadInputAndWarnsOnce)
{
  this->Renderer->SetBackground(0.2, 0.4, 0.6);
  this->Caster->SetMedium(nullptr);
  const std::vector<float> plain = this->Render();
  this->Caster->SetMedium(this->Medium);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double bad[][3] = { { nan, 1.0, 0.0 }, { 1.0, nan, 0.0 },
    { std::numeric_limits<double>::infinity(), 1.0, 0.0 }, { 1.0, 1.0, nan } };
  for (const auto& numbers : bad)
  {
    this->Warnings = 0;
    this->Medium->SetScattering(numbers[0]);
    this->Medium->SetExtinction(numbers[1]);
    this->Medium->SetAsymmetry(numbers[2]);
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
  this->Sun->SetIntensity(0.0);
  this->Warnings = 0;
  EXPECT_EQ(plain, this->Render());
  EXPECT_EQ(this->Warnings, 1);
}
