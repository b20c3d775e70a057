// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"
#include "FrameTimes.h"
#include "Processes/MallocSettings.h"
#include "vtkPenumbraOcclusionConstants.h"

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

/// A window that renders its own copy of the scene with one method.
struct Variant
{
  explicit Variant(const OcclusionTestScene& scene)
    : Renderer(scene.Renderer),
      View(std::make_unique<OcclusionWindow>(scene.Renderer))
  {
  }

  /// Renders the next frame after a small camera movement to one side and back.
  void Draw(bool moves, bool counts)
  {
    if (moves)
    {
      this->Renderer->GetActiveCamera()->Azimuth(this->Side);
      this->Side = -this->Side;
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
  double Side = .25;
};

/// Measures all methods. `memory`: configuration of the C library, for the table.
void MeasureFrames(OcclusionBenchmark& benchmark, const std::function<OcclusionTestScene()>& scene,
  const std::string& memory)
{
  const std::string name = scene().Name + ", " + memory;
  const double radius = scene().Radius;
  Variant plain(scene());
  Variant horizon(scene());
  Variant march(scene());
  Variant still(scene());
  Variant vtk32(scene());
  Variant vtk256(scene());
  for (Variant* ours : { &horizon, &march, &still })
  {
    ours->View->UsePenumbraPass(radius)->GetConstants().FirstSamples = 8;
    ours->View->Ours->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
    ours->View->Ours->SetKernelName(ours == &horizon ? "horizon" : "march");
  }
  still.View->Ours->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::ALWAYS);
  for (int frame = 0; frame < HistoryFrames; ++frame)
  {
    horizon.Draw(true, false);
    march.Draw(true, false);
  }
  vtk32.View->UseVTKSSAOPass(radius, 32);
  vtk256.View->UseVTKSSAOPass(radius, 256);
  for (int frame = -WarmingFrames; frame < Rounds; ++frame)
  {
    for (Variant* variant : { &plain, &horizon, &march, &still, &vtk32, &vtk256 })
    {
      variant->Draw(variant != &still, frame >= 0);
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
    const std::string why = "8 new samples and their reprojection are half of the cost; the "
                            "rest renders the margin, filters and composites";
    benchmark.Judge(name, kernel + " / vtkSSAOPass 32", overhead / peer, .25, why);
    benchmark.Judge(name, kernel + " / vtkSSAOPass 256", overhead / peer256, .05, why);
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
  const auto measure = [&](const std::string& memory) {
    for (int index = 0; index < 2; ++index)
    {
      MeasureFrames(
        benchmark, [&]() { return benchmark.Scenes()[index]; }, memory);
    }
  };
  // llvmpipe allocates and frees memory in every frame. By default, the C library returns much of
  // it to the system, and the page faults of the next frame add to its time.
  measure("memory handed back");
  RetainFreedMemory();
  measure("memory kept");
}

}
