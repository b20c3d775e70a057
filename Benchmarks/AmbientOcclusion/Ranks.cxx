// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"
#include "DepthImage.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCamera.h"

#include <cmath>

namespace penumbra
{

namespace
{

/// Composites the scene by depth from the images of the given number of ranks, each with its own
/// actors.
DepthImage DrawByRanks(const OcclusionTestScene& scene, int ranks)
{
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetAlphaBitPlanes(1);
  window->SetSize(OcclusionWindow::Size[0], OcclusionWindow::Size[1]);
  window->AddRenderer(scene.Renderer);
  DepthImage whole;
  for (int rank = 0; rank < ranks; ++rank)
  {
    int actor = 0;
    vtkActorCollection* actors = scene.Renderer->GetActors();
    actors->InitTraversal();
    while (vtkActor* next = actors->GetNextActor())
    {
      next->SetVisibility(actor++ % ranks == rank);
    }
    window->Render();
    const DepthImage part = CaptureDepthImage(window);
    rank == 0 ? void(whole = part) : DepthComposite(whole, part);
  }
  window->RemoveRenderer(scene.Renderer);
  return whole;
}

/// Occlusion of an image, computed by a pass that has no access to the scene.
std::vector<float> Occlude(const DepthImage& image, vtkCamera* camera, double radius)
{
  vtkNew<vtkRenderer> renderer;
  renderer->GetActiveCamera()->DeepCopy(camera);
  OcclusionWindow screen(renderer);
  vtkNew<ShowDepthImagePass> show;
  show->Shown = image;
  renderer->SetPass(show);
  screen.Ours = vtkPenumbraTemporalSSAOPass::AddTo(renderer);
  screen.Ours->SetRadiusUnit(vtkPenumbraTemporalSSAOPass::WORLD);
  screen.Ours->SetRadius(radius);
  screen.Draw();
  return screen.Array("AmbientOcclusion");
}

}

void MeasureRanks(OcclusionBenchmark& benchmark)
{
  const auto draw = [&](int ranks) {
    const OcclusionTestScene scene = Scans(benchmark.Meshes);
    return Occlude(DrawByRanks(scene, ranks), scene.Renderer->GetActiveCamera(), scene.Radius);
  };
  const std::vector<float> one = draw(1);
  const std::vector<float> four = draw(4);
  double pixels = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i)
  {
    pixels += one[i] != four[i];
    largest = std::max(largest, std::abs(static_cast<double>(one[i]) - four[i]));
  }
  ResultTable& table = benchmark.Results;
  table.Add("Scans", "1 against 4 sort-last ranks, pixels that differ", pixels, TargetKind::AtMost,
    0.0, "four actors, composited by depth");
  table.Add(
    "Scans", "1 against 4 sort-last ranks, largest difference", largest, TargetKind::AtMost, 0.0);
}

}
