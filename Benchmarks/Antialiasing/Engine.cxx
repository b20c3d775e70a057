// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Measurements of the engine: dense meshes, ray packets, memory.
#include "Benchmark.h"
#include "Meshes.h"
#include "Scene.h"
#include "Surface.h"

#include "Embree/RayScene.h"
#include "Import/SceneExtraction.h"
#include "Shading/Shading.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"

#include <malloc.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <sstream>

namespace penumbra
{
namespace
{

double CpuSeconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Returns a line of /proc/self/status in bytes.
double StatusBytes(const std::string& name)
{
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
  {
    if (line.compare(0, name.size(), name) == 0)
    {
      return std::stod(line.substr(name.size() + 1)) * 1024.0;
    }
  }
  return 0.0;
}

/// Resets the peak to the memory that is resident now.
void ResetPeakMemory()
{
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;
}

/// Casts and shades all 4x4 blocks of an image with packets or with single rays; returns CPU
/// seconds.
double Pass(const RayScene& rays, const Shading& shading, int size, bool packets, double& sum)
{
  const Camera& eye = rays.GetScene().ViewCamera;
  const double start = CpuSeconds();
  long long shadowRays = 0;
  Ray block[16];
  Hit hits[16];
  for (int y = 0; y < size; y += 4)
  {
    for (int x = 0; x < size; x += 4)
    {
      for (int k = 0; k < 16; ++k)
      {
        const glm::dvec2 p(x + k % 4 + 0.5, y + k / 4 + 0.5);
        block[k].Origin = eye.RayOrigin(p);
        block[k].Direction = eye.RayDirection(p);
      }
      if (packets)
      {
        rays.Intersect16(block, hits);
      }
      for (int k = 0; k < 16; ++k)
      {
        const Hit hit = packets ? hits[k] : rays.Intersect(block[k]);
        if (hit.IsHit())
        {
          sum += shading.Shade(block[k], hit, shadowRays).Color.r;
        }
      }
    }
  }
  return CpuSeconds() - start;
}

}

void MeasureDenseMesh(Benchmark& benchmark)
{
  constexpr int size = 64;
  vtkSmartPointer<vtkPolyData> mesh = Subdivide(ReadOff(benchmark.MeshFile("armadillo")), 2);
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, mesh, true);
  LookAlong(renderer, { 0.6, -0.3, 1.0 }, { 0.0, 1.0, 0.0 }, size, size);
  const BruteForceImage truth =
    DrawByBruteForce(BruteForceOf(renderer, size, size), size, size, 128);
  const std::vector<bool> isEdge = SilhouettePixels(truth);
  const auto best = [&](penumbra::CoverageMethods method, Answer& answer) {
    for (int i = 0; i < 5; ++i)
    {
      Answer next = Cast(renderer, size, size,
        [&](vtkPenumbraRayCaster* caster) { caster->GetConstants().CoverageMethod = method; });
      if (i == 0 || next.Seconds < answer.Seconds)
      {
        answer = std::move(next);
      }
    }
  };
  Answer ours;
  Answer uniform;
  best(penumbra::CoverageMethods::Silhouettes, ours);
  best(penumbra::CoverageMethods::Uniform, uniform);
  const std::string scene = std::to_string(mesh->GetNumberOfPolys()) + " triangles at 64^2";
  const Errors errors = Judge(benchmark, scene, ours, truth.Colors, isEdge, size);
  const Errors reference = Compare(uniform.Colors, truth.Colors, isEdge);
  ResultTable& table = benchmark.Results;
  table.Add(scene, "full RMSE / that of uniform 8x8", errors.Full / reference.Full,
    TargetKind::AtMost, 1.0, "Penumbra " + std::to_string(errors.Full));
  table.Add(scene, "edge RMSE / that of uniform 8x8", errors.Edge / reference.Edge,
    TargetKind::AtMost, 1.0, "Penumbra " + std::to_string(errors.Edge));
  table.Add(scene, "time / that of uniform 8x8", ours.Seconds / uniform.Seconds, TargetKind::AtMost,
    1.0,
    "Penumbra " + std::to_string(ours.Seconds) + " s, " + std::to_string(ours.RaysPerPixel) +
      " rays/pixel");
}

void MeasureBasePass(Benchmark& benchmark)
{
  constexpr int size = 1024;
  vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, ReadOff(benchmark.MeshFile("ChineseDragon-10kv")), true);
  LookAlong(renderer, { -0.6, -0.3, -1.0 }, { 0.0, 1.0, 0.0 }, size, size);
  ExtractionOptions options;
  options.Resolution[0] = options.Resolution[1] = size;
  const Scene scene = ExtractScene(renderer, options);
  const RayScene rays(scene, 1);
  const Shading shading(rays, false);
  double single = 0.0;
  double packets = 0.0;
  double sum = 0.0;
  for (int i = 0; i < 5; ++i)
  {
    const double first = Pass(rays, shading, size, false, sum);
    const double second = Pass(rays, shading, size, true, sum);
    single = i ? std::min(single, first) : first;
    packets = i ? std::min(packets, second) : second;
  }
  benchmark.Results.Add("base pass, 20k triangles", "packets of 16 / single rays, shaded",
    single / packets, TargetKind::AtLeast, 3.0,
    std::to_string(size * size / packets / 1e6) + " against " +
      std::to_string(size * size / single / 1e6) + " Mray/s");
}

void AddNormalsAndScalars(vtkPolyData* mesh)
{
  vtkNew<vtkFloatArray> normals;
  vtkNew<vtkFloatArray> scalars;
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(mesh->GetNumberOfPoints());
  scalars->SetNumberOfTuples(mesh->GetNumberOfPoints());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    normals->SetTuple3(i, 0.0, 0.0, 1.0);
    scalars->SetValue(i, static_cast<float>(mesh->GetPoint(i)[2]));
  }
  mesh->GetPointData()->SetNormals(normals);
  mesh->GetPointData()->SetScalars(scalars);
}

/// `hasArrays`: with point normals and scalars, by which the mesh is colored.
void MeasureLargeMesh(Benchmark& benchmark, bool hasArrays)
{
  const double atStart = StatusBytes("VmRSS:");
  vtkSmartPointer<vtkPolyData> mesh = WavySheet(2237);
  if (hasArrays)
  {
    AddNormalsAndScalars(mesh);
  }
  const double arrays = 1024.0 *
    (mesh->GetPoints()->GetActualMemorySize() + mesh->GetPolys()->GetActualMemorySize() +
      mesh->GetPointData()->GetActualMemorySize());
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetInputDataObject(0, mesh);
  caster->SetResolution(1024, 1024);
  caster->SetNumberOfThreads(1);
  ResetPeakMemory();
  const double start = CpuSeconds();
  caster->Update();
  const double seconds = CpuSeconds() - start;
  const double peak = StatusBytes("VmHWM:") - atStart;
  std::ostringstream remark;
  remark.precision(3);
  remark << "input arrays " << arrays / 1e6 << " MB, peak with them " << peak / 1e6 << " MB, "
         << seconds << " CPU s; edges are not drawn";
  benchmark.Results.Add(hasArrays ? "10 M triangles, normals, scalars" : "10 M triangles, points",
    "peak memory / input arrays", peak / arrays, TargetKind::AtMost, 4.0, remark.str());
  malloc_trim(0);
}

void MeasureMemory(Benchmark& benchmark)
{
  MeasureLargeMesh(benchmark, false);
  MeasureLargeMesh(benchmark, true);
  {
    vtkSmartPointer<vtkPolyData> mesh = ReadOff(benchmark.MeshFile("elephant"));
    double afterTen = 0.0;
    for (int i = 0; i < 1000; ++i)
    {
      vtkNew<vtkPenumbraRayCaster> caster;
      caster->SetInputDataObject(0, mesh);
      caster->SetResolution(96, 96);
      caster->SetNumberOfThreads(1);
      caster->Update();
      afterTen = i == 9 ? StatusBytes("VmRSS:") : afterTen;
    }
    const double grown = (StatusBytes("VmRSS:") - afterTen) / 1048576.0;
    benchmark.Results.Add("1,000 images in one process", "MiB grown after the tenth", grown,
      TargetKind::AtMost, 2.0, "constant: less than a quarter of a page per image");
  }
  std::ifstream maps("/proc/self/maps");
  int libraries = 0;
  std::string names;
  for (std::string line; std::getline(maps, line);)
  {
    for (const char* name :
      { "/libGL.", "/libGLX", "/libEGL", "/libOpenGL.", "/libOSMesa", "/libX11" })
    {
      if (line.find(name) != std::string::npos && names.find(name) == std::string::npos)
      {
        names += name;
        ++libraries;
      }
    }
  }
  benchmark.Results.Add("1,000 images in one process", "OpenGL, EGL and X libraries loaded",
    libraries, TargetKind::AtMost, 0.0, names);
}

}
