// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"
#include "BytesInUse.h"
#include "vtkPenumbraOcclusionConstants.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCamera.h"

#include <functional>

namespace penumbra
{

namespace
{

/// Growth of the memory in use per additional pixel of a window.
double BytesPerPixel(const OcclusionTestScene& scene, const std::function<void()>& addPass,
  const std::function<void()>& change)
{
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->AddRenderer(scene.Renderer);
  addPass();
  double bytes[2];
  const int heights[2] = { OcclusionWindow::Size[1] / 2, OcclusionWindow::Size[1] };
  // Rendered twice, so that all shaders are compiled.
  for (const int step : { 0, 1, 0, 1 })
  {
    window->SetSize(OcclusionWindow::Size[0], heights[step]);
    for (int frame = 0; frame < 4; ++frame)
    {
      change();
      window->Render();
    }
    window->WaitForCompletion();
    bytes[step] = BytesInUse();
  }
  window->RemoveRenderer(scene.Renderer);
  return (bytes[1] - bytes[0]) / (OcclusionWindow::Size[0] * (heights[1] - heights[0]));
}

}

void MeasureMemory(OcclusionBenchmark& benchmark)
{
  const auto measure = [&](bool occludes, bool actorsMove, double margin = -1.0) {
    const OcclusionTestScene scene = Spheres400();
    return BytesPerPixel(
      scene,
      [&]() {
        if (occludes)
        {
          auto* pass = vtkPenumbraTemporalSSAOPass::AddTo(scene.Renderer);
          pass->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
          pass->GetConstants().Margin = margin;
        }
      },
      [&]() {
        scene.Renderer->GetActiveCamera()->Azimuth(.25);
        if (actorsMove)
        {
          scene.Renderer->GetActors()->GetLastActor()->AddPosition(0.0, 0.0, .01);
        }
      });
  };
  const double plain = measure(false, false);
  ResultTable& table = benchmark.Results;
  table.Add("S400", "plain window, bytes per pixel", plain, TargetKind::None);
  table.Add("S400", "memory of the pass without margin, bytes per pixel",
    measure(true, false, 0.0) - plain, TargetKind::None);
  const std::string margin =
    "the margin adds pixels: up to a tenth of the larger side around the image";
  benchmark.Judge(
    "S400", "memory of the pass, bytes per pixel", measure(true, false) - plain, 40.0, margin);
  benchmark.Judge("S400", "memory of the pass if actors have moved, bytes per pixel",
    measure(true, true) - plain, 40.0, margin);
}

}
