// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Ten million triangles with normals and scalars: memory, and the share of the time in which only one
// thread can work.
#include "Benchmark.h"
#include "Memory.h"
#include "Scenes/AccuracyScenes.h"
#include "Scenes/TestScene.h"

#include "Execution/ParallelFor.h"

#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"

#include <chrono>
#include <cstdio>

namespace
{

using namespace penumbra;

constexpr double Triangles = 1e7;
constexpr int Width = 1000;
constexpr int Height = 600;
constexpr double MaximumMemoryRatio = 3.0; ///< peak in addition to the input / input
constexpr double MaximumSerialShare = 0.03;
constexpr double MinimumTasks = 8 * 64; ///< 8 tasks for each of 64 cores

vtkSmartPointer<vtkPolyData> MakeInput()
{
  const vtkSmartPointer<vtkPolyData> mesh = MakeGyroid(Triangles, true);
  vtkNew<vtkFloatArray> heights;
  heights->SetName("Height");
  heights->SetNumberOfTuples(mesh->GetNumberOfPoints());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    heights->SetValue(i, static_cast<float>(mesh->GetPoint(i)[2]));
  }
  mesh->GetPointData()->SetScalars(heights);
  return mesh;
}

}

void MeasureTriangles(Options& options)
{
  const vtkSmartPointer<vtkPolyData> mesh = MakeInput();
  const double input = 1.024e-3 * static_cast<double>(mesh->GetActualMemorySize());
  const vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, mesh, true);
  LookAlong(renderer, { -0.3, -0.4, -1.0 }, { 0.0, 1.0, 0.0 }, Width, Height);
  for (const int threads : { 1, 2 })
  {
    vtkNew<vtkPenumbraRayCaster> caster;
    caster->SetRenderer(renderer);
    caster->SetResolution(Width, Height);
    caster->SetNumberOfThreads(threads);
    const double before = ResetPeakMegabytes();
    TakeParallelLoopTotals();
    const auto start = std::chrono::steady_clock::now();
    caster->Update();
    const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double peak = ReadPeakMegabytes() - before;
    const ParallelLoopTotals loops = TakeParallelLoopTotals();
    const double build = caster->GetPhaseSeconds(vtkPenumbraRayCaster::BUILD);
    const std::string scene = "gyroid of " + std::to_string(mesh->GetNumberOfPolys()) +
      " triangles, " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
    char remark[200];
    std::snprintf(remark, sizeof remark, "%.0f MB; points, normals, scalars and triangles: %.0f MB",
      peak, input);
    options.Results.Add(scene, "peak memory in addition to the input / input", peak / input,
      TargetKind::AtMost, MaximumMemoryRatio, remark);
    std::snprintf(remark, sizeof remark,
      "%.2f s: extraction %.2f, build %.2f, edges %.2f, tracing %.2f", seconds,
      caster->GetPhaseSeconds(vtkPenumbraRayCaster::EXTRACTION), build,
      caster->GetPhaseSeconds(vtkPenumbraRayCaster::EDGES),
      caster->GetPhaseSeconds(vtkPenumbraRayCaster::TRACING));
    options.Results.Add(scene, "seconds", seconds, TargetKind::None, 0.0, remark);
    if (threads == 1)
    {
      options.Results.Add(scene, "time outside of parallel loops and of the build / time",
        (seconds - loops.Seconds - build) / seconds, TargetKind::AtMost, MaximumSerialShare,
        "Embree builds in parallel");
      options.Results.Add(scene, "tasks of the loop with the fewest",
        static_cast<double>(loops.FewestTasks), TargetKind::AtLeast, MinimumTasks,
        "8 for each of 64 cores");
    }
  }
}
