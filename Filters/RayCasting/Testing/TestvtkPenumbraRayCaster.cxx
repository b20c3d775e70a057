// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Embree/RayScene.h"
#include "Scene.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"

#include "vtkActor.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCommand.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMinimalStandardRandomSequence.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

namespace
{

/// Three spheres of different colors that overlap in the image, lit by the headlight.
class RayCaster : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->Add(0.0, 0.0, 0.0, 12, { 1.0, 1.0, 1.0 });
    this->Add(0.7, 0.2, 0.5, 24, { 0.9, 0.3, 0.1 });
    this->Add(-0.9, 0.6, -0.4, 16, { 0.2, 0.4, 0.8 });
    this->Renderer->SetBackground(0.1, 0.2, 0.3);
    this->Renderer->GetActiveCamera()->SetPosition(0.3, -0.4, 6.0);
    this->Renderer->GetActiveCamera()->SetFocalPoint(0.0, 0.1, 0.0);
    this->Caster->SetRenderer(this->Renderer);
    this->Caster->SetResolution(101, 75);
  }

  void Add(double x, double y, double z, int resolution, std::array<double, 3> color)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(x, y, z);
    sphere->SetThetaResolution(resolution);
    sphere->SetPhiResolution(resolution);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(sphere->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(color[0], color[1], color[2]);
    actor->GetProperty()->SetInterpolationToFlat();
    this->Renderer->AddActor(actor);
  }

  vtkFloatArray* Array(const char* name)
  {
    return vtkFloatArray::SafeDownCast(this->Caster->GetOutput()->GetPointData()->GetArray(name));
  }

  double Statistic(const char* name)
  {
    return this->Caster->GetStatistics()->GetArray(name)->GetTuple1(0);
  }

  std::vector<float> Render()
  {
    this->Caster->UpdateWholeExtent();
    vtkFloatArray* color = this->Array("Color");
    return std::vector<float>(
      color->GetPointer(0), color->GetPointer(0) + color->GetNumberOfValues());
  }

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkPenumbraRayCaster> Caster;
};

}

TEST_F(RayCaster, HasTheRequestedResolution)
{
  this->Render();
  int dimensions[3];
  this->Caster->GetOutput()->GetDimensions(dimensions);
  EXPECT_EQ(dimensions[0], 101);
  EXPECT_EQ(dimensions[1], 75);
  EXPECT_EQ(dimensions[2], 1);
}

TEST_F(RayCaster, IsIndependentOfThreadCount)
{
  this->Caster->SetNumberOfThreads(1);
  const std::vector<float> one = this->Render();
  for (int threads : { 2, 3, 8 })
  {
    this->Caster->SetNumberOfThreads(threads);
    const std::vector<float> many = this->Render();
    EXPECT_EQ(0, std::memcmp(one.data(), many.data(), one.size() * sizeof(float))) << threads;
  }
}

TEST_F(RayCaster, IsIndependentOfTheUpdateExtent)
{
  for (const auto method :
    { penumbra::CoverageMethods::Silhouettes, penumbra::CoverageMethods::Subdivision })
  {
    this->Caster->GetConstants().CoverageMethod = method;
    const std::vector<float> whole = this->Render();
    const int tiles[][4] = { { 0, 40, 0, 33 }, { 41, 100, 0, 33 }, { 0, 6, 34, 74 },
      { 7, 100, 34, 74 }, { 50, 50, 37, 37 } };
    for (const auto& tile : tiles)
    {
      const int extent[6] = { tile[0], tile[1], tile[2], tile[3], 0, 0 };
      this->Caster->Modified();
      this->Caster->UpdateExtent(extent);
      int outputExtent[6];
      this->Caster->GetOutput()->GetExtent(outputExtent);
      ASSERT_TRUE(std::equal(outputExtent, outputExtent + 6, extent));
      const float* part = this->Array("Color")->GetPointer(0);
      const int width = tile[1] - tile[0] + 1;
      for (int y = tile[2]; y <= tile[3]; ++y)
      {
        EXPECT_EQ(0,
          std::memcmp(part + 4 * width * (y - tile[2]), whole.data() + 4 * (101 * y + tile[0]),
            4 * width * sizeof(float)))
          << "row " << y << " from " << tile[0];
      }
    }
  }
}

TEST_F(RayCaster, MatchesUniformSampling)
{
  const std::vector<float> exact = this->Render();
  this->Caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Uniform;
  this->Caster->GetConstants().UniformSamples = 32;
  const std::vector<float> samples = this->Render();
  double squares = 0.0;
  float worst = 0.f;
  for (std::size_t i = 0; i < exact.size(); ++i)
  {
    squares += (exact[i] - samples[i]) * (exact[i] - samples[i]);
    worst = std::max(worst, std::abs(exact[i] - samples[i]));
  }
  EXPECT_LT(std::sqrt(squares / exact.size()), 5e-4);
  EXPECT_LT(worst, 0.02f); // the error of 32 samples along an edge is 1/64 at most
}

TEST_F(RayCaster, CountsEachPixelOnce)
{
  this->Render();
  EXPECT_EQ(this->Statistic("Rays/Primary"), 102.0 * 76.0);
  EXPECT_EQ(this->Statistic("Pixels/Empty") + this->Statistic("Pixels/Interior") +
      this->Statistic("Pixels/Edge") + this->Statistic("Pixels/SmallObject") +
      this->Statistic("Pixels/Refined") + this->Statistic("Pixels/Uniform"),
    101.0 * 75.0);
  EXPECT_LT(this->Statistic("Rays/PerPixel"), 2.0);
}

TEST_F(RayCaster, CompositesOverAnyColorWithoutBackground)
{
  this->Caster->BackgroundOff();
  const std::vector<float> withoutBackground = this->Render();
  this->Caster->BackgroundOn();
  const std::vector<float> withBackground = this->Render();
  const float background[3] = { 0.1f, 0.2f, 0.3f };
  for (std::size_t i = 0; i < withoutBackground.size(); i += 4)
  {
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(withoutBackground[i + c] * withoutBackground[i + 3] +
          background[c] * (1.f - withoutBackground[i + 3]),
        withBackground[i + c], 1.f / 255.f);
    }
  }
}

TEST_F(RayCaster, UpdatesTheCachedSceneBetweenExtents)
{
  const auto renderExtent = [&](int low) {
    int extent[6] = { 20, 79, low, low + 19, 0, 0 };
    this->Caster->UpdateExtent(extent);
    const float* part = this->Array("Color")->GetPointer(0);
    return std::vector<float>(part, part + 4 * 60 * 20);
  };
  const std::vector<float> parts[2] = { renderExtent(10), renderExtent(30) };
  vtkActor::SafeDownCast(this->Renderer->GetViewProps()->GetItemAsObject(0))->SetPosition(1, 1, 0);
  EXPECT_NE(parts[1], renderExtent(30));
  vtkActor::SafeDownCast(this->Renderer->GetViewProps()->GetItemAsObject(0))->SetPosition(0, 0, 0);
  const std::vector<float> whole = this->Render();
  for (int y = 0; y < 40; ++y)
  {
    const auto row = parts[y / 20].begin() + 4 * 60 * (y % 20);
    EXPECT_TRUE(std::equal(row, row + 4 * 60, whole.begin() + 4 * (101 * (10 + y) + 20))) << y;
  }
}

/// Brute force that records the ids of its scenes.
class RecordingProvider : public vtkPenumbraBruteForceIrradiance
{
public:
  static RecordingProvider* New();
  vtkTypeMacro(RecordingProvider, vtkPenumbraBruteForceIrradiance);

  bool Begin(const penumbra::RayScene& scene, const Occluders& occluders, double tolerance,
    const Progress& progress) override
  {
    this->Scenes.insert(scene.GetId());
    return this->Superclass::Begin(scene, occluders, tolerance, progress);
  }

  std::set<std::uint64_t> Scenes;
};
vtkStandardNewMacro(RecordingProvider);

TEST_F(RayCaster, BuildsTheSceneOnceForAllExtents)
{
  vtkNew<RecordingProvider> provider;
  this->Caster->AmbientOcclusionOn();
  this->Caster->SetIrradianceProvider(provider);
  for (const int low : { 10, 20, 30 })
  {
    int extent[6] = { 20, 29, low, low + 9, 0, 0 };
    this->Caster->UpdateExtent(extent);
  }
  EXPECT_EQ(provider->Scenes.size(), 1U);
}

TEST_F(RayCaster, RejectsInvalidSettings)
{
  this->Caster->SetTolerance(std::nan(""));
  vtkObject::GlobalWarningDisplayOff();
  this->Caster->Update();
  EXPECT_EQ(this->Caster->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
  this->Caster->SetTolerance(1.0 / 256.0);
  this->Caster->SetResolution(70000, 1);
  this->Caster->Update();
  EXPECT_EQ(this->Caster->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
  vtkObject::GlobalWarningDisplayOn();
}

/// A provider that throws exceptions.
class FailingProvider : public vtkPenumbraBruteForceIrradiance
{
public:
  static FailingProvider* New();
  vtkTypeMacro(FailingProvider, vtkPenumbraBruteForceIrradiance);

  Estimate Occlusion(const double[3], const double[3], const double*) const override
  {
    throw std::runtime_error("test failure");
  }

  Estimate OcclusionWithin(const double[3], const double[3], double, const double*) const override
  {
    throw std::runtime_error("test failure");
  }
};
vtkStandardNewMacro(FailingProvider);

TEST_F(RayCaster, ReportsExceptionsOfAnyThread)
{
  vtkNew<FailingProvider> provider;
  provider->JoinPixelsOff();
  vtkNew<vtkCallbackCommand> observer;
  std::string message;
  observer->SetClientData(&message);
  observer->SetCallback([](vtkObject*, unsigned long, void* data, void* text) {
    *static_cast<std::string*>(data) += static_cast<const char*>(text);
  });
  this->Caster->AddObserver(vtkCommand::ErrorEvent, observer);
  this->Caster->AmbientOcclusionOn();
  this->Caster->SetIrradianceProvider(provider);
  for (const int threads : { 1, 4 })
  {
    message.clear();
    this->Caster->SetNumberOfThreads(threads);
    this->Caster->Update();
    EXPECT_NE(message.find("test failure"), std::string::npos) << message;
    EXPECT_EQ(this->Caster->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
  }
  this->Caster->SetIrradianceProvider(nullptr);
  EXPECT_TRUE(vtkPenumbraBruteForceIrradiance::SafeDownCast(this->Caster->GetIrradianceProvider()));
}

TEST_F(RayCaster, RendersAndReportsProgressOnTheCallingThread)
{
  const std::vector<float> image = this->Render();
  std::set<std::thread::id> threads;
  vtkNew<vtkCallbackCommand> progress;
  progress->SetClientData(&threads);
  progress->SetCallback([](vtkObject*, unsigned long, void* ids, void*) {
    static_cast<std::set<std::thread::id>*>(ids)->insert(std::this_thread::get_id());
  });
  this->Caster->AddObserver(vtkCommand::ProgressEvent, progress);
  this->Caster->AmbientOcclusionOn();
  this->Render();
  this->Caster->AmbientOcclusionOff();
  EXPECT_EQ(threads, (std::set<std::thread::id>{ std::this_thread::get_id() }));
  threads.clear();
  std::thread other([&] { EXPECT_EQ(image, this->Render()); });
  const std::thread::id id = other.get_id();
  other.join();
  EXPECT_EQ(threads, (std::set<std::thread::id>{ id }));
}

TEST_F(RayCaster, StopsOnAbort)
{
  const std::vector<float> image = this->Render();
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* caller, unsigned long, void*, void*) {
    vtkAlgorithm::SafeDownCast(caller)->AbortExecuteOn();
  });
  const unsigned long observer = this->Caster->AddObserver(vtkCommand::ProgressEvent, stop);
  this->Caster->Modified();
  this->Caster->Update();
  EXPECT_EQ(this->Caster->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(this->Caster->GetStatistics()->GetNumberOfArrays(), 0);
  EXPECT_TRUE(std::isnan(this->Caster->GetEstimatedError()));
  this->Caster->RemoveObserver(observer);
  this->Caster->AbortExecuteOff();
  this->Caster->Modified();
  EXPECT_EQ(image, this->Render());
  EXPECT_GT(this->Statistic("Rays/Total"), 0.0);
}

TEST_F(RayCaster, StopsAtTheNextProgressEvent)
{
  struct Watch
  {
    double StopAt = 0.0;
    int Later = -1; ///< events after the abort was requested
  };
  Watch watch;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&watch);
  observer->SetCallback([](vtkObject* caller, unsigned long, void* data, void*) {
    auto& self = *static_cast<Watch*>(data);
    auto* algorithm = vtkAlgorithm::SafeDownCast(caller);
    if (self.Later >= 0 || algorithm->GetProgress() >= self.StopAt)
    {
      ++self.Later;
      algorithm->SetAbortExecute(1);
    }
  });
  this->Caster->AddObserver(vtkCommand::ProgressEvent, observer);
  this->Caster->GeometryArraysOn();
  this->Caster->SetResolution(40, 30);
  for (const double stopAt : { 0.0, 0.26, 0.4, 0.6, 0.8, 0.9 })
  {
    watch = { stopAt, -1 };
    this->Caster->SetAbortExecute(0);
    this->Caster->Modified();
    this->Caster->Update();
    EXPECT_GE(watch.Later, 0) << stopAt;
    EXPECT_LE(watch.Later, 1) << stopAt; // the last event of vtkAlgorithm
    EXPECT_EQ(this->Caster->GetOutput()->GetNumberOfPoints(), 0) << stopAt;
    EXPECT_EQ(this->Caster->GetStatistics()->GetNumberOfArrays(), 0) << stopAt;
  }
}

TEST_F(RayCaster, RejectsUnusableCameras)
{
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  int errors = 0;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&errors);
  observer->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*) { ++*static_cast<int*>(data); });
  this->Caster->AddObserver(vtkCommand::ErrorEvent, observer);
  this->Caster->AmbientOcclusionOn();
  const auto expectError = [&](const char* what) {
    errors = 0;
    this->Caster->Update();
    EXPECT_EQ(errors, 1) << what;
    EXPECT_EQ(this->Caster->GetOutput()->GetNumberOfPoints(), 0) << what;
  };
  camera->SetViewAngle(std::nan(""));
  expectError("angle");
  camera->SetViewAngle(30.0);
  camera->SetPosition(std::nan(""), 0.0, 1.0);
  expectError("position");
  camera->SetPosition(std::numeric_limits<double>::infinity(), 0.0, 1.0);
  expectError("far position");
}

TEST_F(RayCaster, TerminatesForPointsThatAreNotFinite)
{
  for (const double bad : { std::nan(""), std::numeric_limits<double>::infinity() })
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->InsertNextPoint(0.0, 0.0, 2.0);
    points->InsertNextPoint(0.2, 0.0, 2.0);
    points->InsertNextPoint(0.0, 0.2, 2.0);
    points->InsertNextPoint(bad, 0.0, 0.0);
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell({ 0, 1, 2 });
    cells->InsertNextCell({ 0, 1, 3 });
    vtkNew<vtkPolyData> mesh;
    mesh->SetPoints(points);
    mesh->SetPolys(cells);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(mesh);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->Renderer->AddActor(actor);
    this->Caster->AmbientOcclusionOn();
    this->Caster->IndirectLightOn();
    this->Caster->SetResolution(40, 30);
    // The finite triangle is visible, and no value of the other one reaches a color.
    const std::vector<float> colors = this->Render();
    EXPECT_TRUE(
      std::all_of(colors.begin(), colors.end(), [](float value) { return std::isfinite(value); }));
    this->Renderer->RemoveActor(actor);
    EXPECT_NE(colors, this->Render());
  }
}

TEST_F(RayCaster, RendersFiniteColorsForDegenerateSlivers)
{
  // The normals of these triangles vanish in single precision.
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(3);
  const auto next = [&]() {
    random->Next();
    return random->GetValue();
  };
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (vtkIdType i = 0; i < 2000; ++i)
  {
    const double a[3] = { next(), next(), next() };
    const double b[3] = { next(), next(), next() };
    points->InsertNextPoint(a);
    points->InsertNextPoint(b);
    points->InsertNextPoint(b[0] + 1e-8 * next(), b[1] + 1e-8 * next(), b[2] + 1e-8 * next());
    cells->InsertNextCell({ 3 * i, 3 * i + 1, 3 * i + 2 });
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  this->Renderer->RemoveAllViewProps();
  this->Renderer->AddActor(actor);
  this->Renderer->ResetCamera();
  this->Caster->AmbientOcclusionOn();
  this->Caster->IndirectLightOn();
  this->Caster->SetResolution(160, 120);
  for (const float value : this->Render())
  {
    ASSERT_TRUE(std::isfinite(value));
  }
}

TEST_F(RayCaster, RendersAgainAfterTheSceneChanges)
{
  const std::vector<float> before = this->Render();
  this->Renderer->GetActiveCamera()->Azimuth(10.0);
  EXPECT_NE(before, this->Render());
}

TEST_F(RayCaster, RendersAgainAfterAConstantChanges)
{
  const double before = (this->Render(), this->Statistic("Rays/Total"));
  this->Caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Uniform;
  this->Caster->GetConstants().UniformSamples = 3;
  this->Render();
  EXPECT_NE(this->Statistic("Rays/Total"), before);
  EXPECT_EQ(this->Statistic("Rays/Total"), 9.0 * 101.0 * 75.0);
}

TEST(RayCasterOcclusion, MatchesTheClosedFormOfOcclusionBesideAWall)
{
  // Occlusion by a wall of height 1 along y at distance d on the floor: (1 - d / sqrt(d^2 + 1)) /
  // 2.
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkPlaneSource> floor;
  floor->SetOrigin(0.0, -500.0, 0.0);
  floor->SetPoint1(3.0, -500.0, 0.0);
  floor->SetPoint2(0.0, 500.0, 0.0);
  vtkNew<vtkPlaneSource> wall;
  wall->SetOrigin(0.0, -500.0, 0.0);
  wall->SetPoint1(0.0, 500.0, 0.0);
  wall->SetPoint2(0.0, -500.0, 1.0);
  for (vtkPlaneSource* plane : { floor.Get(), wall.Get() })
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(plane->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    renderer->AddActor(actor);
  }
  renderer->GetActiveCamera()->SetPosition(1.0, 0.0, 10.0);
  renderer->GetActiveCamera()->SetFocalPoint(1.0, 0.0, 0.0);
  renderer->GetActiveCamera()->ParallelProjectionOn();
  renderer->GetActiveCamera()->SetParallelScale(0.75);
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(renderer);
  caster->SetResolution(16, 16); // a pixel is 0.09375 wide, the left side of the image is x = 0.25
  caster->AmbientOcclusionOn();
  caster->SetAmbientOcclusionRadius(1000.0);
  caster->GeometryArraysOn();
  caster->Update();
  vtkPointData* data = caster->GetOutput()->GetPointData();
  auto* occlusion = vtkFloatArray::SafeDownCast(data->GetArray("AmbientOcclusion"));
  auto* color = vtkFloatArray::SafeDownCast(data->GetArray("Color"));
  for (int x = 0; x < 16; ++x)
  {
    const double d = 0.25 + (x + 0.5) * 0.09375;
    const double exact = 0.5 * (1.0 - d / std::sqrt(d * d + 1.0));
    double meanOcclusion = 0.0;
    double meanColor = 0.0;
    for (int y = 0; y < 16; ++y)
    {
      meanOcclusion += occlusion->GetValue(16 * y + x) / 16.0;
      meanColor += color->GetTypedComponent(16 * y + x, 0) / 16.0;
    }
    // The tolerance of light: neighbors share their rays, so that their errors do not average out.
    EXPECT_NEAR(meanOcclusion, exact, 0.01) << d;
    EXPECT_NEAR(meanColor, 1.0 - exact, 0.01) << d;
  }
}
