// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Baked direct light of lights with a size, against closed forms.
#include "vtkPenumbraIrradianceFilter.h"

#include "ClosedForms/VisibleLight.h"
#include "SphereOnFloor.h"

#include "vtkCallbackCommand.h"
#include "vtkCellData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

using namespace penumbra_testing;

namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double EdgeHeight = 2.0;
constexpr double Tolerance = 0.005;

/// Returns a half-plane x < 0 at the height EdgeHeight.
vtkSmartPointer<vtkPolyData> MakeHalfPlane()
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-1000.0, -1000.0, EdgeHeight);
  plane->SetPoint1(0.0, -1000.0, EdgeHeight);
  plane->SetPoint2(-1000.0, 1000.0, EdgeHeight);
  plane->Update();
  return plane->GetOutput();
}

using Choice = std::function<void(vtkPenumbraIrradianceFilter*)>;

vtkSmartPointer<vtkPenumbraIrradianceFilter> Bake(vtkPolyData* occluder, const Choice& choose)
{
  auto filter = vtkSmartPointer<vtkPenumbraIrradianceFilter>::New();
  filter->SetInputData(MakeFloor(60)->GetOutput());
  if (occluder)
  {
    filter->SetInputData(1, occluder);
  }
  filter->SetQuantity(vtkPenumbraIrradianceFilter::DIRECT_LIGHT);
  filter->SetTolerance(Tolerance);
  choose(filter);
  filter->Update();
  return filter;
}

vtkDataArray* GetLight(vtkPenumbraIrradianceFilter* filter)
{
  return GetPolyData(filter)->GetPointData()->GetArray("DirectLight");
}

/// RMSE over all points of the floor, and the largest error.
double ComputeRmse(vtkPenumbraIrradianceFilter* filter,
  const std::function<double(double x, double y)>& exact, double& largest)
{
  double square = 0.0;
  largest = 0.0;
  vtkDataArray* values = GetLight(filter);
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    double x[3];
    GetPolyData(filter)->GetPoint(i, x);
    const double error = values->GetComponent(i, 0) - exact(x[0], x[1]);
    square += error * error;
    largest = std::max(largest, std::abs(error));
  }
  return std::sqrt(square / static_cast<double>(values->GetNumberOfTuples()));
}

/// Errors of an execution that must fail.
std::string FindError(const Choice& choose)
{
  std::string errors;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&errors);
  observer->SetCallback([](vtkObject*, unsigned long, void* client, void* text) {
    *static_cast<std::string*>(client) += static_cast<const char*>(text);
  });
  const auto filter = Bake(nullptr, [&](vtkPenumbraIrradianceFilter* target) {
    target->AddObserver(vtkCommand::ErrorEvent, observer);
    target->AddObserver(vtkCommand::WarningEvent, observer);
    choose(target);
  });
  EXPECT_EQ(GetLight(filter) == nullptr, errors.find("contains") == std::string::npos);
  return errors;
}

}

TEST(DirectLight, OfSphereBehindHalfPlaneMatchesClosedForm)
{
  const double height = 5.0;
  const double radius = 1.5;
  const auto filter = Bake(MakeHalfPlane(), [&](vtkPenumbraIrradianceFilter* target) {
    target->AddLight(0.5, 0.0, height, 1.0);
    target->SetLightRadius(radius);
  });
  double largest = 0.0;
  const double rmse = ComputeRmse(
    filter,
    [&](double x, double y) {
      const double distance = std::sqrt((0.5 - x) * (0.5 - x) + y * y + height * height);
      // Cosine of the angle between the light and the normal of the plane through point and edge.
      const double cosine =
        ((0.5 - x) * EdgeHeight + x * height) / (distance * std::hypot(EdgeHeight, x));
      return height / distance *
        penumbra::ConeInHemisphere(std::asin(radius / distance), std::acos(cosine));
    },
    largest);
  EXPECT_LE(rmse, Tolerance);
  EXPECT_LE(largest, 8.0 * Tolerance);
  EXPECT_LE(filter->GetEstimatedError(), Tolerance);
  EXPECT_GT(GetStatistic(filter, "Rays/Shadow"), 0.0);
  EXPECT_EQ(GetStatistic(filter, "Rays/Total"), GetStatistic(filter, "Rays/Shadow"));
  EXPECT_EQ(GetStatistic(filter, "Points/BruteForce"), 61.0 * 61.0);
}

TEST(DirectLight, OfSunsIsTheSumOfTheirVisibleFractions)
{
  const double elevations[] = { 30.0, 60.0, 90.0, 120.0 };
  const double angle = 10.0;
  const auto filter = Bake(MakeHalfPlane(), [&](vtkPenumbraIrradianceFilter* target) {
    for (const double elevation : elevations)
    {
      const double a = elevation * Pi / 180.0;
      target->AddLight(7.0 * std::cos(a), 0.0, 7.0 * std::sin(a), 0.0); // any length
    }
    target->SetLightAngle(angle);
  });
  double largest = 0.0;
  const double rmse = ComputeRmse(
    filter,
    [&](double x, double) {
      double sum = 0.0;
      for (const double elevation : elevations)
      {
        const double a = elevation * Pi / 180.0;
        const double cosine =
          (std::cos(a) * EdgeHeight + x * std::sin(a)) / std::hypot(EdgeHeight, x);
        sum +=
          std::sin(a) * penumbra::ConeInHemisphere(0.5 * angle * Pi / 180.0, std::acos(cosine));
      }
      return sum;
    },
    largest);
  EXPECT_LE(rmse, Tolerance);
  EXPECT_LE(largest, 8.0 * Tolerance);
}

TEST(DirectLight, IsTheCosineIfUnoccludedAndZeroFromBehind)
{
  for (const double size : { 0.0, 0.5 })
  {
    double largest = 1.0;
    const auto above = Bake(nullptr, [size](vtkPenumbraIrradianceFilter* target) {
      target->AddLight(0.0, 0.0, 1.0, 0.0);
      target->AddLight(0.0, 0.0, -3.0, 0.0); // from behind
      target->AddLight(0.0, 0.0, -3.0, 1.0);
      target->SetLightAngle(size);
      target->SetLightRadius(size);
    });
    EXPECT_EQ(ComputeRmse(
                above, [](double, double) { return 1.0; }, largest),
      0.0);
    const auto near = Bake(nullptr, [size](vtkPenumbraIrradianceFilter* target) {
      target->AddLight(2.0, 4.0, 6.0, 2.0); // (1, 2, 3)
      target->SetLightRadius(size);
    });
    ComputeRmse(
      near,
      [](double x, double y) { return 3.0 / std::sqrt((x - 1) * (x - 1) + (y - 2) * (y - 2) + 9); },
      largest);
    EXPECT_LE(largest, 1e-6);
  }
}

TEST(DirectLight, OfHardLightEndsAtTheEdge)
{
  const auto filter = Bake(MakeHalfPlane(),
    [](vtkPenumbraIrradianceFilter* target) { target->AddLight(0.03, 0.0, 1.0, 0.0); });
  double largest = 1.0;
  const double full = 1.0 / std::hypot(0.03, 1.0);
  ComputeRmse(
    filter, [full](double x, double) { return x > -0.06 ? full : 0.0; }, largest);
  EXPECT_LE(largest, 1e-6);
  EXPECT_LE(GetStatistic(filter, "Rays/Shadow"), 61.0 * 61.0);
}

TEST(DirectLight, OnCellsDoesNotDependOnThreads)
{
  vtkSmartPointer<vtkPenumbraIrradianceFilter> filters[2];
  for (int i = 0; i < 2; ++i)
  {
    filters[i] = Bake(MakeSphere()->GetOutput(), [i](vtkPenumbraIrradianceFilter* target) {
      target->AddLight(3.0, 2.0, 5.0, 1.0);
      target->AddLight(-1.0, 2.0, 5.0, 0.0);
      target->SetLightRadius(1.0);
      target->SetLightAngle(8.0);
      target->OnCellsOn();
      target->SetNumberOfThreads(i == 0 ? 1 : 3);
    });
  }
  vtkDataArray* one = GetPolyData(filters[0])->GetCellData()->GetArray("DirectLight");
  vtkDataArray* three = GetPolyData(filters[1])->GetCellData()->GetArray("DirectLight");
  ASSERT_TRUE(one && three);
  int penumbrae = 0;
  for (vtkIdType i = 0; i < one->GetNumberOfTuples(); ++i)
  {
    EXPECT_EQ(one->GetComponent(i, 0), three->GetComponent(i, 0));
    penumbrae += one->GetComponent(i, 0) < 1.2 ? 1 : 0;
  }
  EXPECT_GT(penumbrae, 20);
}

TEST(DirectLight, RejectsInvalidLights)
{
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::nan("");
  EXPECT_NE(FindError([](vtkPenumbraIrradianceFilter*) {}).find("AddLight"), std::string::npos);
  for (const double bad : { -1.0, nan, infinity })
  {
    EXPECT_NE(FindError([bad](vtkPenumbraIrradianceFilter* target) {
      target->AddLight(0.0, 0.0, 1.0, 1.0);
      target->SetLightRadius(bad);
    }).find("LightRadius must be"),
      std::string::npos);
    EXPECT_NE(FindError([bad](vtkPenumbraIrradianceFilter* target) {
      target->AddLight(0.0, 0.0, 1.0, 0.0);
      target->SetLightAngle(bad);
    }).find("LightAngle must be"),
      std::string::npos);
    EXPECT_NE(FindError([bad](vtkPenumbraIrradianceFilter* target) {
      target->AddLight(1.0, 1.0, 1.0, bad);
    }).find("position of a light"),
      std::string::npos);
  }
  for (const double bad : { nan, infinity })
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      double at[3] = { 1.0, 1.0, 1.0 };
      at[axis] = bad;
      EXPECT_NE(FindError([&at](vtkPenumbraIrradianceFilter* target) {
        target->AddLight(at[0], at[1], at[2], 1.0);
      }).find("position of a light"),
        std::string::npos);
    }
  }
  EXPECT_NE(FindError([](vtkPenumbraIrradianceFilter* target) {
    target->AddLight(0.0, 0.0, 0.0, 0.0);
  }).find("nonzero direction"),
    std::string::npos);
  EXPECT_NE(FindError([](vtkPenumbraIrradianceFilter* target) {
    target->AddLight(0.0, 0.0, 0.3, 1.0);
    target->SetLightRadius(0.5);
  }).find("contains or touches a surface"),
    std::string::npos);
}
