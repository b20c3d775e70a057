// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"
#include "ManualInteractor.h"
#include "vtkPenumbraTracedEstimator.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkSMPTools.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace penumbra
{

namespace
{

/// Sizes of the window, in pixels.
constexpr int Sizes[][2] = { { 128, 96 }, { 640, 480 } };

constexpr int Threads = 2;
constexpr double Tolerance = 0.01;

/// Camera rotation before the view rests, degrees.
constexpr double Turn = 0.25;

/// Side of the tiles whose error is judged, and smallest number of pixels with a reference in a tile.
constexpr int TileSide = 16;
constexpr int FewestPixels = 8;

/// Returns the fraction of the tiles whose RMSE exceeds the tolerance.
double FractionAbove(const OcclusionTruth& truth, const std::vector<float>& image, double tolerance)
{
  struct Sum
  {
    double Squares = 0.0;
    int Count = 0;
  };
  std::map<std::pair<int, int>, Sum> tiles;
  for (std::size_t i = 0; i < truth.Pixels.size(); ++i)
  {
    const int pixel = truth.Pixels[i];
    Sum& tile = tiles[{ pixel % truth.Width / TileSide, pixel / truth.Width / TileSide }];
    tile.Squares += std::pow(image[static_cast<std::size_t>(pixel)] - truth.Constant[i], 2.0);
    ++tile.Count;
  }
  double above = 0.0;
  double judged = 0.0;
  for (const auto& [where, tile] : tiles)
  {
    judged += tile.Count >= FewestPixels;
    above += tile.Count >= FewestPixels && std::sqrt(tile.Squares / tile.Count) > tolerance;
  }
  return judged > 0.0 ? above / judged : 0.0;
}

}

void MeasureSettling(OcclusionBenchmark& benchmark)
{
  vtkPenumbraTracedEstimator::Register();
  for (const OcclusionTestScene& scene : benchmark.Scenes())
  {
    for (const int* size : Sizes)
    {
      vtkSMPTools::Initialize();
      // Every second pixel, for enough pixels in a tile.
      const OcclusionTruth truth =
        TraceOcclusion(scene.Renderer, size, scene.Radius, 2, benchmark.Rays);
      vtkSMPTools::Initialize(Threads);
      for (const char* kernel : { "automatic", "march" })
      {
        OcclusionWindow screen(scene.Renderer, size[0], size[1]);
        vtkPenumbraTemporalSSAOPass* pass = screen.UsePenumbraPass(scene.Radius);
        pass->SetKernelName(kernel);
        pass->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
        scene.Renderer->GetActiveCamera()->Azimuth(Turn);
        screen.Draw(); // builds the BVH and compiles shaders
        scene.Renderer->GetActiveCamera()->Azimuth(-Turn);
        vtkRenderWindow* window = scene.Renderer->GetRenderWindow();
        vtkNew<ManualInteractor> interactor;
        interactor->SetRenderWindow(window);
        interactor->Initialize();
        double frames = 0.0;
        vtkNew<vtkCallbackCommand> counter;
        counter->SetClientData(&frames);
        counter->SetCallback(
          [](vtkObject*, unsigned long, void* count, void*) { ++*static_cast<double*>(count); });
        window->AddObserver(vtkCommand::EndEvent, counter);
        screen.Draw();
        const double start = vtkTimerLog::GetUniversalTime();
        const std::clock_t startCPU = std::clock();
        double longest = 0.0;
        while (!interactor->Timers.empty())
        {
          const double before = vtkTimerLog::GetUniversalTime();
          interactor->Tick();
          longest = std::max(longest, vtkTimerLog::GetUniversalTime() - before);
        }
        const double seconds = vtkTimerLog::GetUniversalTime() - start;
        const double secondsCPU = static_cast<double>(std::clock() - startCPU) / CLOCKS_PER_SEC;
        interactor->SetRenderWindow(nullptr);
        const std::string name = scene.Name + " " + std::to_string(size[0]) + "x" +
          std::to_string(size[1]) + ", " + kernel;
        ResultTable& table = benchmark.Results;
        benchmark.Judge(name, "seconds until settled", seconds, 3.0,
          "surfaces of many small objects need more rays per pixel");
        table.Add(name, "CPU seconds until settled", secondsCPU, TargetKind::None);
        table.Add(name, "frames until settled", frames, TargetKind::None);
        table.Add(name, "longest tick, s", longest, TargetKind::None);
        if (pass->GetActiveKernelName() == std::string("traced"))
        {
          const std::vector<float> image = screen.Array("AmbientOcclusion");
          table.Add(name, "RMSE against rays", Rmse(truth, Falloff::Constant, image),
            TargetKind::AtMost, Tolerance);
          table.Add(name, "tiles above the tolerance, %",
            100.0 * FractionAbove(truth, image, Tolerance), TargetKind::None);
        }
      }
    }
  }
}

}
