// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"
#include "ClosedForms/VisibleLight.h"
#include "PovRay.h"
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

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>

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
vtkSmartPointer<vtkPenumbraRayCaster> CastFloor(
  vtkPolyData* occluder, glm::dvec2 center, double tolerance = Tolerance)
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
  caster->SetTolerance(tolerance);
  caster->SetLightTolerance(tolerance);
  caster->Update();
  return caster;
}

double CountShadowRays(vtkPenumbraRayCaster* caster)
{
  return caster->GetStatistics()->GetArray("Rays/Shadow")->GetComponent(0, 0) / (Size * Size);
}

/// Exact image of the floor, and the pixels in the penumbra.
struct ExactFloor
{
  std::vector<double> Values;
  std::vector<int> Penumbra;
};

ExactFloor ComputeFloor(double (*fraction)(glm::dvec2))
{
  ExactFloor floor;
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
    floor.Values.push_back(exact);
    if (high > 0.0 && low < 1.0)
    {
      floor.Penumbra.push_back(i);
    }
  }
  return floor;
}

template <typename ValueAt>
double ComputeRmse(const ExactFloor& floor, const ValueAt& valueAt)
{
  double squares = 0.0;
  for (const int i : floor.Penumbra)
  {
    squares += std::pow(valueAt(i) - floor.Values[i], 2.0);
  }
  return std::sqrt(squares / static_cast<double>(floor.Penumbra.size()));
}

void MeasureOccluder(ResultTable& table, const std::string& name, vtkPolyData* occluder,
  double (*fraction)(glm::dvec2), glm::dvec2 lit)
{
  const double start = Seconds();
  const vtkSmartPointer<vtkPenumbraRayCaster> caster = CastFloor(occluder, glm::dvec2(0.0));
  const double seconds = Seconds() - start;
  vtkDataArray* colors = caster->GetOutput()->GetPointData()->GetArray("Color");
  const ExactFloor floor = ComputeFloor(fraction);
  table.Add(name, "RMSE in the penumbra",
    ComputeRmse(floor, [=](int i) { return colors->GetComponent(i, 0); }), TargetKind::AtMost, .005,
    "tolerance " + Brief(Tolerance) + ", " + Brief(seconds) + " s");
  const double elsewhere = CountShadowRays(CastFloor(occluder, lit));
  const double share = static_cast<double>(floor.Penumbra.size()) / (Size * Size);
  table.Add(name, "shadow rays per pixel in the penumbra",
    (CountShadowRays(caster) - elsewhere * (1.0 - share)) / share, TargetKind::AtMost, 16.0);
  table.Add(name, "shadow rays per pixel elsewhere", elsewhere, TargetKind::AtMost, 1.1);
}

/// Grid of point lights of POV-Ray's area_light.
struct LightGrid
{
  int Side;
  int Adaptive; ///< first subdivision of the adaptive sampling
  bool Jitter;
};

void WritePovRayFloor(const std::string& path, const std::string& occluder, const LightGrid& grid)
{
  std::ofstream file(path);
  const double width = ImageWidth / CameraHeight;
  file
    << "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\ncamera { perspective location <0,0,"
    << CameraHeight << "> right <" << width << ",0,0> up <0," << width
    << ",0> direction <0,0,-1> }\nlight_source { <0,0," << LightHeight << "> rgb 1 area_light <"
    << 2.0 * LightRadius << ",0,0>, <0," << 2.0 * LightRadius << ",0>, " << grid.Side << ", "
    << grid.Side << " adaptive " << grid.Adaptive << " circular" << (grid.Jitter ? " jitter" : "")
    << " }\npolygon { 5, <-20,-20,0>, <20,-20,0>, <20,20,0>, <-20,20,0>, <-20,-20,0> pigment { rgb "
       "1 } "
       "finish { ambient 0 diffuse 1 } }\n"
    << occluder << '\n';
}

/// CPU seconds and RMSE in the penumbra against the closed form.
struct CostOfFloor
{
  double Seconds = 0.0;
  double Rmse = 0.0;
};

/// Returns ours for several tolerances, from coarse to fine: the fastest of three runs each, including
/// the BVH.
std::vector<CostOfFloor> MeasureOurs(vtkPolyData* mesh, const ExactFloor& floor)
{
  constexpr int Repetitions = 3;
  std::vector<CostOfFloor> costs;
  for (const double tolerance : { .05, .035, .025, .017, .012, .0085, Tolerance })
  {
    CostOfFloor cost;
    cost.Seconds = std::numeric_limits<double>::infinity();
    for (int i = 0; i < Repetitions; ++i)
    {
      const double start = Seconds();
      const vtkSmartPointer<vtkPenumbraRayCaster> caster =
        CastFloor(mesh, glm::dvec2(0.0), tolerance);
      cost.Seconds = std::min(cost.Seconds, Seconds() - start);
      vtkDataArray* colors = caster->GetOutput()->GetPointData()->GetArray("Color");
      cost.Rmse = ComputeRmse(floor, [=](int pixel) { return colors->GetComponent(pixel, 0); });
    }
    costs.push_back(cost);
  }
  return costs;
}

/// One run of POV-Ray: its time is that of tracing only.
struct PovRayFloor
{
  std::string Setting;
  CostOfFloor Cost;
  double Noise = 0.0; ///< RMSE against the image of its finest grid
};

std::vector<PovRayFloor> MeasurePovRay(
  const LightBenchmark& benchmark, const std::string& occluder, const ExactFloor& floor)
{
  const std::string file = benchmark.Output + "/penumbra.pov";
  const auto run = [&](const LightGrid& grid) {
    WritePovRayFloor(file, occluder, grid);
    return RunPovRay(benchmark.PovRay, file, Size, Size, { 0.0, 0 });
  };
  const PovRayAnswer finest = run({ 129, 2, false });
  ExactFloor limit = floor;
  std::transform(finest.Colors.begin(), finest.Colors.end(), limit.Values.begin(),
    [](const glm::dvec3& color) { return color.x; });
  std::vector<PovRayFloor> runs;
  for (const int side : { 9, 17, 33, 65 })
  {
    for (const LightGrid& grid : { LightGrid{ side, 1, false }, LightGrid{ side, 1, true },
           LightGrid{ side, 2, false }, LightGrid{ side, 2, true } })
    {
      const PovRayAnswer answer = run(grid);
      const auto valueAt = [&](int i) { return answer.Colors[i].x; };
      PovRayFloor found;
      found.Setting = std::to_string(side) + " x " + std::to_string(side) + " adaptive " +
        std::to_string(grid.Adaptive) + (grid.Jitter ? " jitter" : "");
      found.Cost = { answer.TraceSeconds, ComputeRmse(floor, valueAt) };
      found.Noise = ComputeRmse(limit, valueAt);
      std::printf("  POV-Ray %s: RMSE %.5f, from its finest grid %.5f, %.3f s\n",
        found.Setting.c_str(), found.Cost.Rmse, found.Noise, found.Cost.Seconds);
      runs.push_back(found);
    }
  }
  return runs;
}

/// Returns the fastest run that meets a condition.
template <typename Condition>
const PovRayFloor* FindFastest(const std::vector<PovRayFloor>& runs, const Condition& condition)
{
  const PovRayFloor* fastest = nullptr;
  for (const PovRayFloor& run : runs)
  {
    if (condition(run) && (!fastest || run.Cost.Seconds < fastest->Cost.Seconds))
    {
      fastest = &run;
    }
  }
  return fastest;
}

/// POV-Ray's circular lights are not uniform, so that their error ends at a limit. Both programs are
/// compared at 1.05 times this limit, and at our error with POV-Ray's error against its own limit.
void CompareWithPovRay(const LightBenchmark& benchmark, ResultTable& table, const std::string& name,
  vtkPolyData* mesh, const std::string& occluder, double (*fraction)(glm::dvec2))
{
  const ExactFloor floor = ComputeFloor(fraction);
  const std::vector<CostOfFloor> ours = MeasureOurs(mesh, floor);
  const std::vector<PovRayFloor> runs = MeasurePovRay(benchmark, occluder, floor);
  const auto best = std::min_element(runs.begin(), runs.end(),
    [](const PovRayFloor& a, const PovRayFloor& b) { return a.Cost.Rmse < b.Cost.Rmse; });
  const double error = 1.05 * best->Cost.Rmse;
  const PovRayFloor* equal =
    FindFastest(runs, [=](const PovRayFloor& run) { return run.Cost.Rmse <= error; });
  const auto own = std::find_if(
    ours.begin(), ours.end(), [=](const CostOfFloor& cost) { return cost.Rmse <= error; });
  const auto describe = [](const CostOfFloor& cost, const PovRayFloor& run, double runError) {
    return Brief(cost.Seconds) + " s, RMSE " + Brief(cost.Rmse) + "; POV-Ray " +
      Brief(run.Cost.Seconds) + " s, RMSE " + Brief(runError) + ", " + run.Setting;
  };
  if (own != ours.end())
  {
    table.Add(name, "times faster than POV-Ray's area light at equal error",
      equal->Cost.Seconds / own->Seconds, TargetKind::AtLeast, 10.0,
      describe(*own, *equal, equal->Cost.Rmse));
  }
  const CostOfFloor& fine = ours.back();
  const PovRayFloor* quiet =
    FindFastest(runs, [&](const PovRayFloor& run) { return run.Noise <= fine.Rmse; });
  if (quiet)
  {
    table.Add(name, "the same, POV-Ray's error against its own limit",
      quiet->Cost.Seconds / fine.Seconds, TargetKind::None, 0.0,
      describe(fine, *quiet, quiet->Noise));
  }
}

}

void MeasurePenumbrae(LightBenchmark& benchmark)
{
  MeasureOccluder(benchmark.Results, "half-plane, disk-shaped light", MakeHalfPlane(),
    FractionBeyondHalfPlane, { 5.0, 0.0 });
  MeasureOccluder(
    benchmark.Results, "disk, disk-shaped light", MakeDisk(), FractionBeyondDisk, { 0.0, 5.0 });
}

void ComparePenumbrae(LightBenchmark& benchmark)
{
  if (benchmark.PovRay.empty())
  {
    return;
  }
  CompareWithPovRay(benchmark, benchmark.Results, "half-plane, disk-shaped light", MakeHalfPlane(),
    "polygon { 5, <-100,-100,2>, <0,-100,2>, <0,100,2>, <-100,100,2>, <-100,-100,2> no_image }",
    FractionBeyondHalfPlane);
  CompareWithPovRay(benchmark, benchmark.Results, "disk, disk-shaped light", MakeDisk(),
    "disc { <0,0,2>, z, " + Brief(DiskRadius) + " no_image }", FractionBeyondDisk);
}

}
