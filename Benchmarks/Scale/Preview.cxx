// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A window of the ray cast pass that turns around a million triangles: time of the first image of each view.
#include "Benchmark.h"
#include "Scenes/AccuracyScenes.h"
#include "Scenes/TestScene.h"

#include "vtkCamera.h"
#include "vtkNew.h"
#include "vtkPenumbraRayCastPass.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <vector>

namespace
{

using namespace penumbra;

constexpr double Triangles = 1e6;
constexpr int Width = 1000;
constexpr int Height = 600;
constexpr int Views = 15;
constexpr double DegreesPerView = 10.0;
constexpr double PreviewTarget = 0.1; // elapsed seconds

double GetCpuSeconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}

void MeasurePreviews(Options& options)
{
  const vtkSmartPointer<vtkPolyData> mesh = MakeGyroid(Triangles, true);
  const vtkSmartPointer<vtkRenderer> renderer = NewRenderer();
  AddMesh(renderer, mesh, true);
  LookAlong(renderer, { -0.3, -0.4, -1.0 }, { 0.0, 1.0, 0.0 }, Width, Height);
  vtkNew<vtkPenumbraRayCastPass> pass;
  pass->GetRayCaster()->SetNumberOfThreads(2);
  renderer->SetPass(pass);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(Width, Height);
  window->AddRenderer(renderer);
  window->Render(); // extracts the scene and builds its BVH
  std::vector<double> seconds;
  const double cpuBefore = GetCpuSeconds();
  for (int view = 0; view < Views; ++view)
  {
    renderer->GetActiveCamera()->Azimuth(DegreesPerView);
    renderer->ResetCameraClippingRange();
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    window->Render();
    seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
  }
  const double cpu = (GetCpuSeconds() - cpuBefore) / Views;
  std::sort(seconds.begin(), seconds.end());
  char remark[160];
  std::snprintf(remark, sizeof remark, "slowest %.3g s; %.3g CPU s per view; TimeLimit %.3g s",
    seconds.back(), cpu, pass->GetTimeLimit());
  options.Results.Add("gyroid of a million triangles, window, 2 threads",
    "first image of a view after the build, median, s", seconds[Views / 2], TargetKind::AtMost,
    PreviewTarget, remark);
}
