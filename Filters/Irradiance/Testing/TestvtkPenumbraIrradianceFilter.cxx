// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares baked values with closed forms, and tests settings, progress and abort of the filter.
#include "vtkPenumbraIrradianceFilter.h"

#include "ClosedForms/FalloffOcclusion.h"
#include "Gathering/Gatherer.h"
#include "SphereOnFloor.h"

#include "vtkCallbackCommand.h"
#include "vtkContourFilter.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPenumbraEnvironment.h"
#include "vtkPenumbraGatherer.h"
#include "vtkPenumbraIrradianceProvider.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRTAnalyticSource.h"
#include "vtkReverseSense.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

using namespace penumbra_testing;

TEST(vtkPenumbraIrradianceFilter, MeetsToleranceNextToSphere)
{
  const auto mesh = MakeSphereOnFloor(120);
  for (const double tolerance : { .03, .01 })
  {
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputData(mesh);
    filter->SetTolerance(tolerance);
    filter->SetRadius(VTK_DOUBLE_MAX);
    filter->Update();
    EXPECT_LE(ComputeFloorRmse(GetPolyData(filter)), tolerance);
    EXPECT_LT(GetStatistic(filter, "Cache/Records"), .3 * GetStatistic(filter, "Points/Total"));
    EXPECT_GT(
      GetStatistic(filter, "Points/Interpolated"), .5 * GetStatistic(filter, "Points/Total"));
    EXPECT_LE(filter->GetEstimatedError(), 1.5 * tolerance);
  }
}

TEST(vtkPenumbraIrradianceFilter, MeetsToleranceOnSlivers)
{
  // Contours have arbitrarily thin triangles.
  vtkNew<vtkRTAnalyticSource> wavelet;
  vtkNew<vtkContourFilter> contour;
  contour->SetInputConnection(wavelet->GetOutputPort());
  contour->SetValue(0, 170.0);
  contour->Update();
  const auto bake = [&](int method, double tolerance) {
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputData(contour->GetOutput());
    filter->SetMethod(method);
    filter->SetTolerance(tolerance);
    filter->Update();
    return vtkSmartPointer<vtkDataArray>(
      GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion"));
  };
  const auto reference = bake(vtkPenumbraIrradianceFilter::BRUTE_FORCE, .004);
  for (const double tolerance : { .1, .05, .02 })
  {
    const auto baked = bake(vtkPenumbraIrradianceFilter::AUTOMATIC, tolerance);
    double square = 0.0;
    for (vtkIdType i = 0; i < reference->GetNumberOfTuples(); ++i)
    {
      square += std::pow(baked->GetComponent(i, 0) - reference->GetComponent(i, 0), 2.0);
    }
    EXPECT_LE(std::sqrt(square / static_cast<double>(reference->GetNumberOfTuples())), tolerance);
  }
}

TEST(vtkPenumbraIrradianceFilter, MeetsToleranceByBruteForce)
{
  const auto mesh = MakeSphereOnFloor(40);
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(mesh);
  filter->SetMethod(vtkPenumbraIrradianceFilter::BRUTE_FORCE);
  filter->SetRadius(VTK_DOUBLE_MAX);
  filter->Update();
  EXPECT_LE(ComputeFloorRmse(GetPolyData(filter)), .01);
  EXPECT_EQ(GetStatistic(filter, "Cache/Records"), 0);
}

TEST(vtkPenumbraIrradianceFilter, IsIndependentOfThreadCount)
{
  const auto mesh = MakeSphereOnFloor(30);
  vtkSmartPointer<vtkDataArray> first;
  for (const int threads : { 1, 3 })
  {
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputData(mesh);
    filter->SetNumberOfThreads(threads);
    filter->SetTolerance(.05);
    filter->Update();
    vtkDataArray* values = GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion");
    if (!first)
    {
      first = values;
      continue;
    }
    for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
    {
      ASSERT_EQ(values->GetComponent(i, 0), first->GetComponent(i, 0));
    }
  }
}

TEST(vtkPenumbraIrradianceFilter, IsExactOnPlaneAndInsideClosedSphere)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(20, 20);
  vtkNew<vtkSphereSource> inside;
  inside->SetThetaResolution(20);
  inside->SetPhiResolution(20);
  inside->Update();
  vtkDataArray* normals = inside->GetOutput()->GetPointData()->GetNormals();
  for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
  {
    const double* n = normals->GetTuple3(i);
    normals->SetTuple3(i, -n[0], -n[1], -n[2]);
  }
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetRadius(VTK_DOUBLE_MAX);
  filter->SetInputConnection(plane->GetOutputPort());
  filter->Update();
  double range[2];
  GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion")->GetRange(range);
  EXPECT_EQ(range[1], 0.0);
  filter->SetInputData(inside->GetOutput());
  filter->Update();
  GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion")->GetRange(range);
  EXPECT_EQ(range[0], 1.0);
}

TEST(vtkPenumbraIrradianceFilter, WarnsIfAllPointsAreOccludedOrBlack)
{
  const auto warningOf = [](bool inwards, int quantity) {
    const vtkSmartPointer<vtkSphereSource> sphere = MakeSphere();
    sphere->SetThetaResolution(8);
    sphere->SetPhiResolution(6);
    vtkNew<vtkReverseSense> reversed;
    reversed->SetInputConnection(sphere->GetOutputPort());
    reversed->SetReverseNormals(inwards);
    reversed->SetReverseCells(inwards);
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputConnection(reversed->GetOutputPort());
    filter->SetRadius(VTK_DOUBLE_MAX);
    filter->SetQuantity(quantity);
    filter->SetTolerance(.05);
    std::string message;
    vtkNew<vtkCallbackCommand> observer;
    observer->SetClientData(&message);
    observer->SetCallback([](vtkObject*, unsigned long, void* to, void* text) {
      *static_cast<std::string*>(to) += static_cast<const char*>(text);
    });
    filter->AddObserver(vtkCommand::WarningEvent, observer);
    filter->Update();
    return message;
  };
  const int occlusion = vtkPenumbraIrradianceFilter::AMBIENT_OCCLUSION;
  EXPECT_EQ(warningOf(false, occlusion), "");
  const std::string warning = warningOf(true, occlusion);
  EXPECT_NE(warning.find("All points are occluded"), std::string::npos);
  EXPECT_NE(warning.find("vtkReverseSense"), std::string::npos);
  const int irradiance = vtkPenumbraIrradianceFilter::IRRADIANCE;
  EXPECT_EQ(warningOf(false, irradiance), "");
  EXPECT_NE(warningOf(true, irradiance).find("the irradiance is 0"), std::string::npos);
}

TEST(vtkPenumbraIrradianceFilter, VerticesOccludeAsSpheres)
{
  vtkNew<vtkPolyData> mesh;
  mesh->DeepCopy(MakeFloor(40)->GetOutput());
  const vtkIdType center = mesh->GetPoints()->InsertNextPoint(0.0, 0.0, 1.0);
  mesh->GetPointData()->Initialize();
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell(1, &center);
  mesh->SetVerts(vertices);
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(mesh);
  filter->SetRadius(VTK_DOUBLE_MAX);
  filter->SetPointRadius(1.0);
  filter->Update();
  EXPECT_LE(ComputeFloorRmse(GetPolyData(filter)), .01);
}

TEST(vtkPenumbraIrradianceFilter, LinesOccludeAsTubes)
{
  // A long tube of radius 1 that touches the floor occludes 1 / (1 + x^2) at the distance x.
  vtkNew<vtkPolyData> mesh;
  mesh->DeepCopy(MakeFloor(40)->GetOutput());
  const vtkIdType ends[2] = { mesh->GetPoints()->InsertNextPoint(0.0, -60.0, 1.0),
    mesh->GetPoints()->InsertNextPoint(0.0, 60.0, 1.0) };
  mesh->GetPointData()->Initialize();
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(2, ends);
  mesh->SetLines(lines);
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(mesh);
  filter->SetRadius(VTK_DOUBLE_MAX);
  filter->SetLineRadius(1.0);
  filter->SetMethod(vtkPenumbraIrradianceFilter::BRUTE_FORCE);
  filter->Update();
  vtkPolyData* baked = GetPolyData(filter);
  vtkDataArray* values = baked->GetPointData()->GetArray("AmbientOcclusion");
  ASSERT_TRUE(values);
  double square = 0.0;
  int count = 0;
  for (vtkIdType i = 0; i < baked->GetNumberOfPoints(); ++i)
  {
    double x[3];
    baked->GetPoint(i, x);
    if (x[2] == 0.0 && std::abs(x[0]) > .1)
    {
      square += std::pow(values->GetComponent(i, 0) - 1.0 / (1.0 + x[0] * x[0]), 2.0);
      ++count;
    }
  }
  EXPECT_LE(std::sqrt(square / count), .01);
}

TEST(vtkPenumbraIrradianceFilter, AddsNoArrayIfAborted)
{
  const auto mesh = MakeSphereOnFloor(60);
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(mesh);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*) {
    static_cast<vtkPenumbraIrradianceFilter*>(caller)->SetAbortExecute(1);
  });
  filter->AddObserver(vtkCommand::ProgressEvent, abort);
  filter->Update();
  EXPECT_FALSE(GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion"));
}

namespace
{

/// Counts the calls of Make(), before which nothing can be gathered.
class CountingGatherer : public vtkPenumbraGatherer
{
public:
  static CountingGatherer* New();
  vtkTypeMacro(CountingGatherer, vtkPenumbraGatherer);
  std::unique_ptr<penumbra::Gatherer> Make(const penumbra::RayGatherer&) override
  {
    ++this->Made;
    return nullptr;
  }
  void Report(vtkFieldData*) const override {}
  int Made = 0;
};
vtkStandardNewMacro(CountingGatherer);

}

TEST(vtkPenumbraIrradianceFilter, StopsWithinOneProgressEvent)
{
  struct Watch
  {
    double StopAt;
    int Later = -1; ///< number of events after the request to stop
  };
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(0.0, 0.0, 1.0);
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(16);
  sphere->SetPhiResolution(12);
  vtkNew<vtkAppendPolyData> mesh;
  mesh->AddInputData(MakeFloor(4)->GetOutput());
  mesh->AddInputConnection(sphere->GetOutputPort());
  for (const int quantity :
    { vtkPenumbraIrradianceFilter::AMBIENT_OCCLUSION, vtkPenumbraIrradianceFilter::IRRADIANCE })
  {
    for (const double stopAt : { 0.0, .02, .3, .6 })
    {
      Watch watch{ stopAt };
      vtkNew<vtkCallbackCommand> observer;
      observer->SetClientData(&watch);
      observer->SetCallback([](vtkObject* caller, unsigned long, void* data, void*) {
        auto& self = *static_cast<Watch*>(data);
        auto* filter = static_cast<vtkPenumbraIrradianceFilter*>(caller);
        if (self.Later >= 0 || filter->GetProgress() >= self.StopAt)
        {
          ++self.Later;
          filter->SetAbortExecute(1);
        }
      });
      vtkNew<CountingGatherer> gatherer;
      vtkNew<vtkPenumbraIrradianceFilter> filter;
      filter->SetInputConnection(mesh->GetOutputPort());
      filter->SetQuantity(quantity);
      filter->SetTolerance(.3);
      filter->SetGatherer(gatherer);
      filter->AddObserver(vtkCommand::ProgressEvent, observer);
      filter->Update();
      EXPECT_GE(watch.Later, 0) << stopAt;
      EXPECT_LE(watch.Later, 1) << stopAt; // the final event that VTK sends
      EXPECT_EQ(GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion"), nullptr)
        << stopAt;
      EXPECT_EQ(GetPolyData(filter)->GetPointData()->GetArray("Irradiance"), nullptr) << stopAt;
      EXPECT_EQ(filter->GetStatistics()->GetNumberOfArrays(), 0) << stopAt;
      EXPECT_TRUE(gatherer->Made == 0 || stopAt > 0.0) << stopAt;
    }
  }
}

TEST(vtkPenumbraIrradianceFilter, MatchesClosedFormWithFalloff)
{
  vtkNew<vtkPlaneSource> ceiling;
  ceiling->SetOrigin(-20.0, -20.0, .6);
  ceiling->SetPoint1(20.0, -20.0, .6);
  ceiling->SetPoint2(-20.0, 20.0, .6);
  ceiling->Update();
  for (int falloff = 0; falloff < 4; ++falloff)
  {
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputData(MakeFloor(40)->GetOutput());
    filter->SetInputData(1, ceiling->GetOutput());
    filter->SetRadius(2.0);
    filter->SetFalloff(falloff);
    filter->Update();
    vtkDataArray* values = GetPolyData(filter)->GetPointData()->GetArray("AmbientOcclusion");
    const double reference =
      penumbra::FadingOcclusion{ 2.0, penumbra::PowersOfFalloffs[falloff] }.UnderCeiling(.6);
    double square = 0.0;
    for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
    {
      square += std::pow(values->GetComponent(i, 0) - reference, 2.0);
    }
    EXPECT_LE(std::sqrt(square / static_cast<double>(values->GetNumberOfTuples())), .01) << falloff;
  }
}

TEST(vtkPenumbraIrradianceFilter, MatchesClosedFormWithEnvironmentMapAndSun)
{
  vtkNew<vtkImageData> sky; // 1 above, 0 below, and a sun around the zenith
  constexpr int Rows = 180;
  sky->SetDimensions(1, Rows, 1);
  sky->AllocateScalars(VTK_FLOAT, 1);
  for (int row = 0; row < Rows; ++row)
  {
    sky->SetScalarComponentFromDouble(0, row, 0, 0, row == Rows - 1 ? 1e4 : row < Rows / 2 ? 0 : 1);
  }
  vtkNew<vtkPenumbraEnvironment> environment;
  environment->SetImage(sky);
  environment->SetUp(0.0, 0.0, 1.0);
  const double sun = (1e4 - 1.0) * vtkMath::Pi() * std::pow(std::sin(vtkMath::Pi() / Rows), 2.0);
  for (const int method :
    { vtkPenumbraIrradianceFilter::AUTOMATIC, vtkPenumbraIrradianceFilter::BRUTE_FORCE })
  {
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputData(MakeFloor(20)->GetOutput());
    filter->SetQuantity(vtkPenumbraIrradianceFilter::IRRADIANCE);
    filter->SetMethod(method);
    filter->SetEnvironment(environment);
    filter->Update();
    vtkDataArray* values = GetPolyData(filter)->GetPointData()->GetArray("Irradiance");
    for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
    {
      EXPECT_NEAR(values->GetComponent(i, 0), vtkMath::Pi() + sun, .02);
    }
    const auto before = filter->GetMTime();
    environment->Modified();
    EXPECT_GT(filter->GetMTime(), before);
  }
}

TEST(vtkPenumbraIrradianceFilter, AddsNoArrayIfEnvironmentHasNoImage)
{
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(MakeFloor(4)->GetOutput());
  filter->SetQuantity(vtkPenumbraIrradianceFilter::IRRADIANCE);
  filter->SetEnvironment(vtkNew<vtkPenumbraEnvironment>());
  vtkObject::GlobalWarningDisplayOff();
  filter->Update();
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_FALSE(GetPolyData(filter)->GetPointData()->HasArray("Irradiance"));
}

TEST(vtkPenumbraIrradianceFilter, RejectsNaNSettings)
{
  for (auto set :
    { &vtkPenumbraIrradianceFilter::SetTolerance, &vtkPenumbraIrradianceFilter::SetRadius,
      &vtkPenumbraIrradianceFilter::SetPointRadius, &vtkPenumbraIrradianceFilter::SetAlbedo })
  {
    vtkNew<vtkPenumbraIrradianceFilter> filter;
    filter->SetInputConnection(MakeFloor(2)->GetOutputPort());
    (filter.Get()->*set)(std::numeric_limits<double>::quiet_NaN());
    std::string error;
    vtkNew<vtkCallbackCommand> observer;
    observer->SetClientData(&error);
    observer->SetCallback([](vtkObject*, unsigned long, void* heard, void* text) {
      *static_cast<std::string*>(heard) += static_cast<const char*>(text);
    });
    filter->AddObserver(vtkCommand::ErrorEvent, observer);
    filter->Update();
    EXPECT_NE(error.find("must not be NaN"), std::string::npos) << error;
    EXPECT_FALSE(
      vtkPolyData::SafeDownCast(filter->GetOutput())->GetPointData()->HasArray("AmbientOcclusion"));
  }
}

TEST(vtkPenumbraIrradianceFilter, NamesItsEnumerators)
{
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  EXPECT_STREQ(filter->GetQuantityAsString(), "AmbientOcclusion");
  filter->SetQuantityToDirectLight();
  EXPECT_EQ(filter->GetQuantity(), vtkPenumbraIrradianceFilter::DIRECT_LIGHT);
  EXPECT_STREQ(filter->GetQuantityAsString(), "DirectLight");
  filter->SetFalloffToQuadratic();
  EXPECT_EQ(filter->GetFalloff(), vtkPenumbraIrradianceProvider::QUADRATIC);
  filter->SetMethodToBruteForce();
  EXPECT_STREQ(filter->GetMethodAsString(), "BruteForce");
}
