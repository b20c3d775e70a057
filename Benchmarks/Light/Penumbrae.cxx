// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"
#include "ClosedForms/VisibleLight.h"
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkDiskSource.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkReverseSense.h"

#include <cmath>

namespace penumbra
{
namespace
{

constexpr int Size = 160;
constexpr double Pi = 3.14159265358979323846;
constexpr double LightHeight = 4.0;
constexpr double LightRadius = .5;
constexpr double OccluderHeight = 2.0;
constexpr double DiskRadius = .4;
constexpr double CameraHeight = 10.0;
constexpr double ImageWidth = 2.0; ///< on the floor
constexpr double Tolerance = .006;

vtkSmartPointer<vtkPolyData> MakeHalfPlane()
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(0.0, -100.0, OccluderHeight);
  plane->SetPoint1(-100.0, -100.0, OccluderHeight);
  plane->SetPoint2(0.0, 100.0, OccluderHeight);
  plane->Update();
  return plane->GetOutput();
}

vtkSmartPointer<vtkPolyData> MakeDisk()
{
  vtkNew<vtkDiskSource> disk;
  disk->SetInnerRadius(0.0);
  disk->SetOuterRadius(DiskRadius);
  disk->SetCircumferentialResolution(256);
  vtkNew<vtkReverseSense> downward; // the camera above does not see it
  downward->SetInputConnection(disk->GetOutputPort());
  downward->Update();
  vtkSmartPointer<vtkPolyData> data = downward->GetOutput();
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    double x[3];
    data->GetPoint(i, x);
    data->GetPoints()->SetPoint(i, x[0], x[1], OccluderHeight);
  }
  return data;
}

/// Visible fraction of a disk-shaped light at the point p of the floor.
double FractionBeyondHalfPlane(glm::dvec2 p)
{
  return DiskBeyondLine(p.x * (1.0 - LightHeight / OccluderHeight) / LightRadius);
}

double FractionBeyondDisk(glm::dvec2 p)
{
  const double scale = LightHeight / OccluderHeight;
  return 1.0 -
    CommonAreaOfCircles(LightRadius, scale * DiskRadius, glm::length(p * (1.0 - scale))) /
    (Pi * LightRadius * LightRadius);
}

/// A floor under a disk-shaped light and an occluder, which the camera above does not see.
vtkSmartPointer<vtkPenumbraRayCaster> CastFloor(vtkPolyData* occluder, glm::dvec2 center)
{
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  vtkNew<vtkPlaneSource> floor;
  floor->SetOrigin(-20.0, -20.0, 0.0);
  floor->SetPoint1(20.0, -20.0, 0.0);
  floor->SetPoint2(-20.0, 20.0, 0.0);
  floor->Update();
  AddMesh(renderer, floor->GetOutput(), true);
  AddMesh(renderer, occluder, true)->GetProperty()->BackfaceCullingOn();
  renderer->RemoveAllLights();
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(0.0, 0.0, LightHeight);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  light->SetPositional(true);
  light->SetConeAngle(85.0); // spotlights are disks
  light->SetExponent(0.0);
  renderer->AddLight(light);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(center.x, center.y, CameraHeight);
  camera->SetFocalPoint(center.x, center.y, 0.0);
  camera->SetViewUp(0.0, 1.0, 0.0);
  camera->SetViewAngle(2.0 * std::atan(.5 * ImageWidth / CameraHeight) * 180.0 / Pi);
  camera->SetClippingRange(.01, 1000.0);
  auto caster = vtkSmartPointer<vtkPenumbraRayCaster>::New();
  caster->SetRenderer(renderer);
  caster->SetResolution(Size, Size);
  caster->SetNumberOfThreads(1);
  caster->ShadowsOn();
  caster->SetLightRadius(LightRadius);
  caster->SetTolerance(Tolerance);
  caster->Update();
  return caster;
}

double CountShadowRays(vtkPenumbraRayCaster* caster)
{
  return caster->GetStatistics()->GetArray("Rays/Shadow")->GetComponent(0, 0) / (Size * Size);
}

void MeasureOccluder(ResultTable& table, const std::string& name, vtkPolyData* occluder,
  double (*fraction)(glm::dvec2), glm::dvec2 lit)
{
  const double start = Seconds();
  const vtkSmartPointer<vtkPenumbraRayCaster> caster = CastFloor(occluder, glm::dvec2(0.0));
  const double seconds = Seconds() - start;
  vtkDataArray* colors = caster->GetOutput()->GetPointData()->GetArray("Color");
  double squares = 0.0;
  double pixels = 0.0;
  for (int i = 0; i < Size * Size; ++i)
  {
    double exact = 0.0;
    double low = 1.0;
    double high = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      const glm::dvec2 at(i % Size + .25 + .5 * (k % 2), i / Size + .25 + .5 * (k / 2));
      const glm::dvec2 p = ImageWidth * (at / static_cast<double>(Size) - .5);
      const double visible = fraction(p);
      low = std::min(low, visible);
      high = std::max(high, visible);
      exact += .25 * visible * LightHeight / std::sqrt(LightHeight * LightHeight + glm::dot(p, p));
    }
    if (high > 0.0 && low < 1.0)
    {
      squares += std::pow(colors->GetComponent(i, 0) - exact, 2.0);
      pixels += 1.0;
    }
  }
  table.Add(name, "RMSE in the penumbra", std::sqrt(squares / pixels), TargetKind::AtMost, .005,
    "tolerance " + Brief(Tolerance) + ", " + Brief(seconds) + " s");
  const double elsewhere = CountShadowRays(CastFloor(occluder, lit));
  const double share = pixels / (Size * Size);
  table.Add(name, "shadow rays per pixel in the penumbra",
    (CountShadowRays(caster) - elsewhere * (1.0 - share)) / share, TargetKind::AtMost, 16.0);
  table.Add(name, "shadow rays per pixel elsewhere", elsewhere, TargetKind::AtMost, 1.1);
}

}

void MeasurePenumbrae(LightBenchmark& benchmark)
{
  MeasureOccluder(benchmark.Results, "half-plane, disk-shaped light", MakeHalfPlane(),
    FractionBeyondHalfPlane, { 5.0, 0.0 });
  MeasureOccluder(
    benchmark.Results, "disk, disk-shaped light", MakeDisk(), FractionBeyondDisk, { 0.0, 5.0 });
}

}
