// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A million points as spheres: memory, ambient occlusion against meshes, and time next to PyVista.
#include "Benchmark.h"
#include "Memory.h"
#include "Scenes/TestScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkGlyph3DMapper.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>

namespace
{

using namespace penumbra;

constexpr int Points = 1000000;
constexpr double Side = 100.0; ///< of the cube that contains the points
constexpr double Radius = 0.5;
constexpr double OcclusionRadius = 3.0;
constexpr double Tolerance = 0.05;
constexpr int Width = 1000;
constexpr int Height = 600;
constexpr double MaximumMegabytes = 120.0; ///< in addition to the input
constexpr double MaximumOcclusionError = 0.01;
constexpr double MaximumTimeFraction = 1.0 / 3.0; ///< of the time of PyVista

vtkSmartPointer<vtkPolyData> MakePoints(int count, double side)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0.f, static_cast<float>(side));
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(count);
  vtkNew<vtkCellArray> vertices;
  vertices->AllocateExact(count, count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const float x = uniform(random);
    const float y = uniform(random);
    points->SetPoint(i, x, y, uniform(random));
    vertices->InsertNextCell(1, &i);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetVerts(vertices);
  return data;
}

/// Looks at the cube along its diagonal.
void LookAtCube(vtkRenderer* renderer, double side)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetFocalPoint(0.5 * side, 0.5 * side, 0.5 * side);
  camera->SetPosition(2.4 * side, 2.4 * side, 2.4 * side);
  camera->SetViewUp(0.0, 0.0, 1.0);
  renderer->ResetCameraClippingRange();
}

void SetUp(vtkPenumbraRayCaster* caster, vtkRenderer* renderer)
{
  caster->SetRenderer(renderer);
  caster->SetResolution(Width, Height);
  caster->SetAmbientOcclusion(true);
  caster->SetAmbientOcclusionRadius(OcclusionRadius);
  caster->SetTolerance(Tolerance);
  caster->SetLightTolerance(Tolerance);
}

/// Returns the seconds of a frame of PyVista with the same points and view; 0 if it did not run.
double TimePyVista(const Options& options, vtkPolyData* data)
{
  if (options.Python.empty())
  {
    return 0.0;
  }
  const std::string path = options.Output + "/points.f32";
  std::ofstream file(path, std::ios::binary);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    const double* x = data->GetPoint(i);
    const float values[3] = { static_cast<float>(x[0]), static_cast<float>(x[1]),
      static_cast<float>(x[2]) };
    file.write(reinterpret_cast<const char*>(values), sizeof values);
  }
  file.close();
  const std::string command =
    options.Python + " Benchmarks/PyVista/spheres.py " + path + " 2> /dev/null";
  double seconds = 0.0;
  if (FILE* pipe = popen(command.c_str(), "r"))
  {
    if (std::fscanf(pipe, "%lf", &seconds) != 1)
    {
      seconds = 0.0;
    }
    pclose(pipe);
  }
  std::remove(path.c_str());
  return seconds;
}

void MeasureMillion(Options& options)
{
  const vtkSmartPointer<vtkPolyData> data = MakePoints(Points, Side);
  const vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, data, true);
  LookAtCube(renderer, Side);
  const double theirs = TimePyVista(options, data);
  for (const int threads : { 1, 2 })
  {
    vtkNew<vtkPenumbraRayCaster> caster;
    SetUp(caster, renderer);
    caster->SetPointRadius(Radius);
    caster->SetNumberOfThreads(threads);
    const double before = ResetPeakMegabytes();
    const auto start = std::chrono::steady_clock::now();
    caster->Update();
    const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double peak = ReadPeakMegabytes() - before;
    const std::string scene =
      "a million spheres, " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
    char remark[200];
    std::snprintf(
      remark, sizeof remark, "the input takes %.0f MB", 1e-3 * data->GetActualMemorySize());
    options.Results.Add(scene, "peak memory in addition to the input, MB", peak, TargetKind::AtMost,
      MaximumMegabytes, remark);
    std::snprintf(remark, sizeof remark,
      "%.2f s: extraction %.2f, build %.2f, edges %.2f, tracing %.2f; PyVista %.2f s", seconds,
      caster->GetPhaseSeconds(vtkPenumbraRayCaster::EXTRACTION),
      caster->GetPhaseSeconds(vtkPenumbraRayCaster::BUILD),
      caster->GetPhaseSeconds(vtkPenumbraRayCaster::EDGES),
      caster->GetPhaseSeconds(vtkPenumbraRayCaster::TRACING), theirs);
    if (theirs > 0.0)
    {
      options.Results.Add(scene, "time / PyVista's with SSAO in software", seconds / theirs,
        TargetKind::AtMost, MaximumTimeFraction, remark);
    }
    else
    {
      options.Results.Add(scene, "seconds", seconds, TargetKind::None, 0.0, remark);
    }
  }
}

/// Renders the occlusion of points as spheres, or as meshes of 80,000 triangles.
vtkSmartPointer<vtkDataArray> RenderOcclusion(vtkPolyData* data, double side, bool meshes)
{
  const vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  vtkActor* actor = AddMesh(renderer, data, true);
  vtkNew<vtkGlyph3DMapper> glyphs;
  vtkNew<vtkSphereSource> sphere;
  if (meshes)
  {
    sphere->SetRadius(Radius);
    sphere->SetThetaResolution(200);
    sphere->SetPhiResolution(202);
    sphere->Update();
    glyphs->SetInputData(data);
    glyphs->SetSourceConnection(sphere->GetOutputPort());
    actor->SetMapper(glyphs);
  }
  LookAtCube(renderer, side);
  vtkNew<vtkPenumbraRayCaster> caster;
  SetUp(caster, renderer);
  caster->SetResolution(300, 180);
  caster->SetTolerance(0.005);
  caster->SetLightTolerance(0.005);
  caster->SetPointRadius(Radius);
  caster->GeometryArraysOn();
  caster->Update();
  return caster->GetOutput()->GetPointData()->GetArray("AmbientOcclusion");
}

void CompareWithMeshes(Options& options)
{
  constexpr double SmallSide = 5.0;
  const vtkSmartPointer<vtkPolyData> data = MakePoints(100, SmallSide);
  const vtkSmartPointer<vtkDataArray> spheres = RenderOcclusion(data, SmallSide, false);
  const vtkSmartPointer<vtkDataArray> meshes = RenderOcclusion(data, SmallSide, true);
  double squares = 0.0;
  double mean = 0.0;
  int count = 0;
  for (vtkIdType i = 0; i < spheres->GetNumberOfTuples(); ++i)
  {
    const double a = spheres->GetComponent(i, 0);
    const double b = meshes->GetComponent(i, 0);
    if (std::isfinite(a) && std::isfinite(b))
    {
      squares += (a - b) * (a - b);
      mean += a;
      ++count;
    }
  }
  char remark[200];
  std::snprintf(remark, sizeof remark, "%d pixels, mean occlusion %.3f, tolerance of each 0.005",
    count, mean / count);
  options.Results.Add("100 spheres", "RMSE of occlusion against meshes of 80,000 triangles",
    std::sqrt(squares / count), TargetKind::AtMost, MaximumOcclusionError, remark);
}

}

void MeasureSpheres(Options& options)
{
  MeasureMillion(options);
  CompareWithMeshes(options);
}
