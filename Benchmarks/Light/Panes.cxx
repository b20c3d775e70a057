// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"
#include "ClosedForms/FalloffOcclusion.h"
#include "OcclusionWindow.h"
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraIrradianceCache.h"
#include "vtkPenumbraIrradianceFilter.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraTemporalSSAOPass.h"
#include "vtkPenumbraTracedEstimator.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{
namespace
{

constexpr int Width = 120;
constexpr int Height = 40;
constexpr double Left = .05; ///< distance of the left side of the image from the pane
constexpr double PixelWidth = .01;
constexpr double Extent = 20.0; ///< of floor and pane
constexpr double Radius = 1.0;
constexpr double Tolerance = .004;
constexpr double Target = .005;

/// A floor from x = `from`, at z = 0.
vtkSmartPointer<vtkPolyData> MakeFloor(double from, double to, double side, int columns, int rows)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(from, -side, 0.0);
  plane->SetPoint1(to, -side, 0.0);
  plane->SetPoint2(from, side, 0.0);
  plane->SetResolution(columns, rows);
  plane->Update();
  return plane->GetOutput();
}

/// A pane on the floor at x = 0.
vtkSmartPointer<vtkPolyData> MakePane()
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(0.0, -Extent, 0.0);
  plane->SetPoint1(0.0, Extent, 0.0);
  plane->SetPoint2(0.0, -Extent, Extent);
  plane->Update();
  return plane->GetOutput();
}

/// A view of the floor from above, next to the pane.
vtkSmartPointer<vtkRenderer> MakeCorner(double opacity)
{
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, MakeFloor(-Extent, Extent, Extent, 1, 1), false);
  AddMesh(renderer, MakePane(), false)->GetProperty()->SetOpacity(opacity);
  vtkCamera* camera = renderer->GetActiveCamera();
  const double center = Left + .5 * Width * PixelWidth;
  camera->ParallelProjectionOn();
  camera->SetParallelScale(.5 * Height * PixelWidth);
  camera->SetPosition(center, 0.0, Extent + 1.0);
  camera->SetFocalPoint(center, 0.0, 0.0);
  camera->SetViewUp(0.0, 1.0, 0.0);
  camera->SetClippingRange(.5, Extent + 2.0);
  return renderer;
}

struct PaneErrors
{
  double Squares = 0.0;
  double Largest = 0.0;
  double Count = 0.0;

  void Add(double found, double opacity, double distance)
  {
    const double error = found - opacity * FadingOcclusion{ Radius, 0.0 }.BeforeWall(distance);
    this->Squares += error * error;
    this->Largest = std::max(this->Largest, std::abs(error));
    this->Count += 1.0;
  }
};

template <typename ValueAt>
PaneErrors CompareImage(double opacity, const ValueAt& valueAt)
{
  PaneErrors errors;
  for (int pixel = 0; pixel < Width * Height; ++pixel)
  {
    errors.Add(valueAt(pixel), opacity, Left + (pixel % Width + .5) * PixelWidth);
  }
  return errors;
}

PaneErrors CastImage(double opacity, vtkPenumbraIrradianceProvider* provider)
{
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(MakeCorner(opacity));
  caster->SetResolution(Width, Height);
  caster->SetTolerance(Tolerance);
  caster->SetLightTolerance(Tolerance);
  caster->AmbientOcclusionOn();
  caster->SetAmbientOcclusionRadius(Radius);
  caster->GeometryArraysOn();
  caster->SetIrradianceProvider(provider);
  caster->SetNumberOfThreads(1);
  caster->Update();
  vtkDataArray* values = caster->GetOutput()->GetPointData()->GetArray("AmbientOcclusion");
  return CompareImage(opacity, [=](int pixel) { return values->GetComponent(pixel, 0); });
}

PaneErrors TraceFrame(double opacity)
{
  const vtkSmartPointer<vtkRenderer> renderer = MakeCorner(opacity);
  OcclusionWindow window(renderer, Width, Height);
  vtkPenumbraTemporalSSAOPass* pass = window.UsePenumbraPass(Radius);
  pass->SetKernelName("traced");
  pass->SetTolerance(Tolerance);
  pass->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::ALWAYS);
  window.Draw();
  const std::vector<float> values = window.Array("AmbientOcclusion");
  return CompareImage(opacity, [&](int pixel) { return double(values[pixel]); });
}

PaneErrors Bake(double opacity, int method)
{
  const auto addOpacity = [](vtkPolyData* mesh, double value) {
    vtkNew<vtkFloatArray> opacities;
    opacities->SetName("Opacity");
    opacities->SetNumberOfTuples(mesh->GetNumberOfPoints());
    opacities->Fill(value);
    mesh->GetPointData()->AddArray(opacities);
  };
  const vtkSmartPointer<vtkPolyData> floor =
    MakeFloor(Left, Left + Width * PixelWidth, .5 * Height * PixelWidth, Width, Height);
  const vtkSmartPointer<vtkPolyData> pane = MakePane();
  addOpacity(floor, 1.0);
  addOpacity(pane, opacity);
  vtkNew<vtkPenumbraIrradianceFilter> filter;
  filter->SetInputData(floor);
  filter->SetInputData(1, pane);
  filter->SetRadius(Radius);
  filter->SetTolerance(Tolerance);
  filter->SetMethod(method);
  filter->SetOpacityArray("Opacity");
  filter->SetNumberOfThreads(1);
  filter->Update();
  auto* baked = vtkPolyData::SafeDownCast(filter->GetOutput());
  vtkDataArray* values = baked->GetPointData()->GetArray("AmbientOcclusion");
  PaneErrors errors;
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    double x[3];
    baked->GetPoint(i, x);
    errors.Add(values->GetComponent(i, 0), opacity, x[0]);
  }
  return errors;
}

}

void MeasurePanes(LightBenchmark& benchmark)
{
  vtkPenumbraTracedEstimator::Register();
  for (const double opacity : { 0.0, .1, .5, .9, 1.0 })
  {
    const auto add = [&](const char* path, const PaneErrors& errors) {
      benchmark.Results.Add("pane of opacity " + Brief(opacity) + " on a floor",
        std::string("RMSE of occlusion, ") + path, std::sqrt(errors.Squares / errors.Count),
        TargetKind::AtMost, Target, "largest error " + Brief(errors.Largest));
    };
    add("rays", CastImage(opacity, vtkNew<vtkPenumbraBruteForceIrradiance>()));
    add("cache", CastImage(opacity, vtkNew<vtkPenumbraIrradianceCache>()));
    add("baked", Bake(opacity, vtkPenumbraIrradianceFilter::AUTOMATIC));
    add("baked by brute force", Bake(opacity, vtkPenumbraIrradianceFilter::BRUTE_FORCE));
    add("traced estimator", TraceFrame(opacity));
  }
}

}
