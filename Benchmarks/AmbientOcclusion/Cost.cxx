// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"
#include "FrameTimes.h"
#include "Processes/MallocSettings.h"

#include "vtkCamera.h"

#include <functional>
#include <memory>
#include <vector>

namespace penumbra
{

namespace
{

constexpr int WarmingFrames = 2;
constexpr int Rounds = 11;

/// Number of frames in motion until the history of the pixels has converged.
constexpr int HistoryFrames = 20;

/// Sizes of the window, in pixels.
constexpr int Sizes[][2] = { { 320, 224 }, { 1024, 768 } };

/// Camera movement per frame, in degrees.
constexpr double Turn = .25;

/// A window that renders its own copy of the scene with one method.
struct Variant
{
  Variant(const OcclusionTestScene& scene, const int size[2])
    : Renderer(scene.Renderer),
      View(std::make_unique<OcclusionWindow>(scene.Renderer, size[0], size[1]))
  {
  }

  void Draw(bool moves, bool counts)
  {
    if (moves)
    {
      this->Renderer->GetActiveCamera()->Azimuth(Turn);
    }
    const double seconds = this->View->Draw();
    if (counts)
    {
      this->Seconds.push_back(seconds);
    }
  }

  double Over(const Variant& plain) const { return MedianOverhead(this->Seconds, plain.Seconds); }

  vtkSmartPointer<vtkRenderer> Renderer;
  std::unique_ptr<OcclusionWindow> View;
  std::vector<double> Seconds;
};

/// Measures all methods with default settings.
void MeasureFrames(OcclusionBenchmark& benchmark, const std::function<OcclusionTestScene()>& scene,
  const int size[2])
{
  const std::string name =
    scene().Name + ", " + std::to_string(size[0]) + "x" + std::to_string(size[1]);
  const double radius = scene().Radius;
  Variant plain(scene(), size);
  Variant horizon(scene(), size);
  Variant march(scene(), size);
  Variant still(scene(), size);
  Variant vtk32(scene(), size);
  Variant vtk256(scene(), size);
  for (Variant* ours : { &horizon, &march, &still })
  {
    ours->View->UsePenumbraPass(radius)->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
    ours->View->Ours->SetKernelName(ours == &horizon ? "horizon" : "march");
  }
  still.View->Ours->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::ALWAYS);
  vtk32.View->UseVTKSSAOPass(radius, 32);
  vtk256.View->UseVTKSSAOPass(radius, 256);
  for (int frame = 0; frame < HistoryFrames; ++frame)
  {
    for (Variant* variant : { &plain, &horizon, &march, &vtk32, &vtk256 })
    {
      const bool needsHistory = variant == &horizon || variant == &march;
      if (needsHistory || frame >= HistoryFrames - WarmingFrames)
      {
        variant->Draw(true, false);
      }
      else
      {
        variant->Renderer->GetActiveCamera()->Azimuth(Turn);
      }
    }
  }
  still.Draw(false, false);
  still.Draw(false, false);
  for (int frame = 0; frame < Rounds; ++frame)
  {
    for (Variant* variant : { &plain, &horizon, &march, &still, &vtk32, &vtk256 })
    {
      variant->Draw(variant != &still, true);
    }
  }
  const double base = Median(plain.Seconds);
  const double peer = vtk32.Over(plain);
  const double peer256 = vtk256.Over(plain);
  ResultTable& table = benchmark.Results;
  table.Add(name, "plain frame, ms", 1e3 * base, TargetKind::None);
  table.Add(name, "overhead of vtkSSAOPass 32, ms", 1e3 * peer, TargetKind::None);
  for (Variant* ours : { &horizon, &march })
  {
    const std::string kernel = ours == &horizon ? "horizon" : "march";
    const double overhead = ours->Over(plain);
    table.Add(name, "overhead of " + kernel + ", moving, ms", 1e3 * overhead, TargetKind::None);
    benchmark.Judge(name, kernel + " / vtkSSAOPass 32", overhead / peer, .35,
      "reprojection, filter, margin and compositing alone take two thirds of it");
    table.Add(name, kernel + " / vtkSSAOPass 256", overhead / peer256, TargetKind::None);
  }
  const double converged = MedianQuotient(still.Seconds, plain.Seconds);
  if (scene().Name == "S400")
  {
    benchmark.Judge(name, "converged still frame / plain frame", converged, 1.05,
      "one more full-screen step multiplies the image by the occlusion and checks its depths");
  }
  else
  {
    table.Add(name, "converged still frame / plain frame", converged, TargetKind::None);
  }
}

}

void MeasureCost(OcclusionBenchmark& benchmark)
{
  // llvmpipe allocates and frees memory in every frame. By default, the C library returns much of
  // it to the system, and the page faults of the next frame add to its time.
  RetainFreedMemory();
  for (std::size_t index = 0; index < benchmark.Scenes().size(); ++index)
  {
    for (const int* size : Sizes)
    {
      MeasureFrames(
        benchmark, [&]() { return benchmark.Scenes()[index]; }, size);
    }
  }
}

}
