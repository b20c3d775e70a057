// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares baked values with closed forms near surfaces of different mesh densities: records of one
// surface must not be interpolated on another, and those of unoccluded points must not extend to
// occluders.
#include "vtkPenumbraIrradianceFilter.h"

#include "SphereOnFloor.h"

#include "vtkCellData.h"
#include "vtkCubeSource.h"
#include "vtkMath.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace penumbra_testing;

namespace
{

/// Returns a unit square at the height `z` that faces +z or -z.
vtkSmartPointer<vtkPlaneSource> MakePlate(double z, bool up, int side)
{
  auto plate = vtkSmartPointer<vtkPlaneSource>::New();
  plate->SetOrigin(0.0, 0.0, z);
  plate->SetPoint1(up ? 1.0 : 0.0, up ? 0.0 : 1.0, z);
  plate->SetPoint2(up ? 0.0 : 1.0, up ? 1.0 : 0.0, z);
  plate->SetResolution(side, side);
  plate->Update();
  return plate;
}

/// Returns the occlusion of a point by a parallel unit square at the distance h: the mean over all
/// azimuths of r^2 / (r^2 + h^2), with r the horizontal distance at which the square or the maximum
/// distance ends.
double ComputeReference(double x, double y, double h, double maximumDistance)
{
  constexpr int Steps = 360;
  struct Azimuth
  {
    double Cosine;
    double Sine;
  };
  static const std::vector<Azimuth> azimuths = [] {
    std::vector<Azimuth> all;
    for (int i = 0; i < Steps; ++i)
    {
      const double angle = 2.0 * vtkMath::Pi() * (i + .5) / Steps;
      all.push_back({ std::cos(angle), std::sin(angle) });
    }
    return all;
  }();
  double sum = 0.0;
  for (const auto& [cosine, sine] : azimuths)
  {
    const double toX = (cosine > 0.0 ? 1.0 - x : -x) / cosine;
    const double toY = (sine > 0.0 ? 1.0 - y : -y) / sine;
    const double edge = std::max(std::min(toX, toY), 0.0);
    const double square =
      std::min(edge * edge, std::max(maximumDistance * maximumDistance - h * h, 0.0));
    sum += square / (square + h * h) / Steps;
  }
  return sum;
}

struct Errors
{
  double Rmse = 0.0;
  double Maximum = 0.0;
};

/// Bakes a floor under a roof of `side` x `side` squares and returns the errors on both.
Errors ComputePlateErrors(bool onCells, bool up, int side, double h, double radius)
{
  vtkNew<vtkAppendPolyData> append;
  append->AddInputData(MakePlate(0.0, true, 20)->GetOutput());
  append->AddInputData(MakePlate(h, up, side)->GetOutput());
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputConnection(append->GetOutputPort());
  filter->SetOnCells(onCells);
  filter->SetRadius(radius);
  filter->SetComputeNormals(true);
  filter->Update();
  vtkPolyData* baked = GetPolyData(filter);
  vtkDataArray* values =
    (onCells ? static_cast<vtkDataSetAttributes*>(baked->GetCellData()) : baked->GetPointData())
      ->GetArray("AmbientOcclusion");
  Errors errors;
  const vtkIdType count = values->GetNumberOfTuples();
  for (vtkIdType i = 0; i < count; ++i)
  {
    double x[3];
    if (onCells)
    {
      double bounds[6];
      baked->GetCellBounds(i, bounds);
      for (int axis = 0; axis < 3; ++axis)
      {
        x[axis] = .5 * (bounds[2 * axis] + bounds[2 * axis + 1]);
      }
    }
    else
    {
      baked->GetPoint(i, x);
    }
    const bool isFree = up && x[2] > .5 * h;
    const double reference = isFree ? 0.0 : ComputeReference(x[0], x[1], h, radius);
    const double error = std::abs(values->GetComponent(i, 0) - reference);
    errors.Rmse += error * error / static_cast<double>(count);
    errors.Maximum = std::max(errors.Maximum, error);
  }
  errors.Rmse = std::sqrt(errors.Rmse);
  return errors;
}

/// Returns a sphere and three boxes on a floor and close to it, and a wall behind a narrow gap, whose
/// lowest points see light from below.
vtkSmartPointer<vtkPolyData> MakeObjectsOnFloor()
{
  constexpr double Boxes[][6] = { { 1.03, 2.03, -.02, .98, .01, 1.0 },
    { -.5, -.1, -2.5, -2.1, .05, .5 }, { 1.0, 3.0, -4.5, -2.5, .4, .6 } };
  vtkNew<vtkAppendPolyData> append;
  append->AddInputConnection(MakeFloor(50)->GetOutputPort());
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(-2.0, .5, 1.0);
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(40);
  sphere->SetPhiResolution(40);
  append->AddInputConnection(sphere->GetOutputPort());
  vtkNew<vtkPlaneSource> wall;
  wall->SetOrigin(-6.0, 6.05, 0.0);
  wall->SetPoint1(6.0, 6.05, 0.0);
  wall->SetPoint2(-6.0, 6.05, 6.0);
  wall->SetResolution(40, 20);
  append->AddInputConnection(wall->GetOutputPort());
  for (const double* bounds : Boxes)
  {
    vtkNew<vtkCubeSource> box;
    box->SetBounds(bounds);
    append->AddInputConnection(box->GetOutputPort());
  }
  append->Update();
  return append->GetOutput();
}

vtkSmartPointer<vtkDataArray> BakeIrradiance(vtkPolyData* mesh, int method, double tolerance)
{
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(mesh);
  filter->SetQuantity(vtkPenumbraIrradianceFilter::IRRADIANCE);
  filter->SetMethod(method);
  filter->SetTolerance(tolerance);
  filter->SetAlbedo(0.0);
  filter->Update();
  return GetPolyData(filter)->GetPointData()->GetArray("Irradiance");
}

class PlatesOnAssociation : public testing::TestWithParam<bool>
{
};

}

TEST_P(PlatesOnAssociation, MatchClosedFormForCoarseAndFineRoofs)
{
  for (const bool up : { false, true })
  {
    for (const int side : { 1, 2, 20, 40 })
    {
      for (const double h : { .02, .1, .4 })
      {
        for (const double radius : { .5, 10.0, VTK_DOUBLE_MAX })
        {
          const Errors errors = ComputePlateErrors(this->GetParam(), up, side, h, radius);
          const auto what = testing::Message()
            << (up ? "up " : "down ") << side << " h " << h << " radius " << radius;
          // The tolerance is 0.01; near the edges of close roofs, occlusion is discontinuous.
          EXPECT_LE(errors.Rmse, .012) << what;
          EXPECT_LE(errors.Maximum, .2) << what;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Baking, PlatesOnAssociation, testing::Bool(),
  [](const auto& on) { return on.param ? "Cells" : "Points"; });

TEST(BakingNearSurfaces, MeetsToleranceOnCoarseFloorUnderFineSphere)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  sphere->SetCenter(0.0, 0.0, 1.0);
  sphere->SetThetaResolution(72);
  sphere->SetPhiResolution(72);
  vtkNew<vtkAppendPolyData> append;
  append->AddInputData(MakeFloor(24)->GetOutput());
  append->AddInputConnection(sphere->GetOutputPort());
  for (const double radius : { 20.0, VTK_DOUBLE_MAX })
  {
    for (const double tolerance : { .02, .01, .005 })
    {
      vtkNew<vtkPenumbraIrradianceFilter> filter;
      filter->SetInputConnection(append->GetOutputPort());
      filter->SetRadius(radius);
      filter->SetTolerance(tolerance);
      filter->Update();
      vtkPolyData* baked = GetPolyData(filter);
      EXPECT_LE(ComputeFloorRmse(baked), tolerance) << radius;
      vtkDataArray* values = baked->GetPointData()->GetArray("AmbientOcclusion");
      for (vtkIdType i = 0; i < baked->GetNumberOfPoints(); ++i)
      {
        double x[3];
        baked->GetPoint(i, x);
        const double reference = std::pow(1.0 + x[0] * x[0] + x[1] * x[1], -1.5);
        if (x[2] == 0.0 && std::hypot(x[0], x[1]) > .1 && reference > .05)
        {
          EXPECT_GT(values->GetComponent(i, 0), 0.0) << x[0] << " " << x[1];
        }
      }
    }
  }
}

TEST(BakingNearSurfaces, DoesNotInterpolateWhereIrradianceChangesFast)
{
  const vtkSmartPointer<vtkPolyData> mesh = MakeObjectsOnFloor();
  constexpr double Tolerance = .02;
  const auto values = BakeIrradiance(mesh, vtkPenumbraIrradianceFilter::AUTOMATIC, Tolerance);
  const auto references =
    BakeIrradiance(mesh, vtkPenumbraIrradianceFilter::BRUTE_FORCE, .5 * Tolerance);
  double square = 0.0;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const double error = values->GetComponent(i, 0) - references->GetComponent(i, 0);
    square += error * error / static_cast<double>(mesh->GetNumberOfPoints());
    EXPECT_LE(std::abs(error), 5.0 * Tolerance) << i;
  }
  EXPECT_LE(std::sqrt(square), Tolerance);
}
