// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"
#include "Reprojection.h"
#include "vtkPenumbraOcclusionConstants.h"

#include "vtkCamera.h"

#include <cmath>

namespace penumbra
{

namespace
{

using Pass = vtkPenumbraTemporalSSAOPass;

/// In motion: frames until every pixel has history, and frames that are compared.
constexpr int MovingFrames = 32;
constexpr int FollowedFrames = 8;

/// RMS difference over surface pixels for which `chosen` is true.
template <typename Choice>
double Difference(const std::vector<float>& a, const std::vector<float>& b,
  const std::vector<float>& depth, const Choice& chosen)
{
  double sum = 0.0;
  double pixels = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    if (std::isfinite(depth[i]) && chosen(i))
    {
      sum += (static_cast<double>(a[i]) - b[i]) * (static_cast<double>(a[i]) - b[i]);
      pixels += 1.0;
    }
  }
  return pixels > 0.0 ? std::sqrt(sum / pixels) : 0.0;
}

/// Image to which the pass converges at this camera without earlier history, with a much smaller
/// error than any target in every tile.
std::vector<float> Limit(OcclusionWindow& screen)
{
  screen.Ours->SetTolerance(1.5e-3);
  screen.Ours->SetConvergeInOneRender(Pass::ALWAYS);
  screen.Draw();
  return screen.Array("AmbientOcclusion");
}

/// One step per frame, so that the results do not depend on time.
void Start(OcclusionWindow& screen, double radius)
{
  screen.UsePenumbraPass(radius)->SetConvergeInOneRender(Pass::NEVER);
  screen.Ours->GetConstants().StepsPerFrame = 1;
}

}

void MeasureNoise(OcclusionBenchmark& benchmark)
{
  for (const OcclusionTestScene& scene : benchmark.Scenes())
  {
    const auto all = [](std::size_t) { return true; };
    ResultTable& table = benchmark.Results;
    OcclusionWindow screen(scene.Renderer);
    Start(screen, scene.Radius);
    for (int frame = 0; frame < 32; ++frame)
    {
      screen.Draw();
    }
    const std::vector<float> after32 = screen.Array("AmbientOcclusion");
    const std::vector<float> depth = screen.Array("Depth");
    while (!screen.Ours->IsConverged())
    {
      screen.Draw();
    }
    const std::vector<float> converged = screen.Array("AmbientOcclusion");
    screen.Draw();
    const double change = Difference(converged, screen.Array("AmbientOcclusion"), depth, all);
    const double estimated = screen.Ours->GetEstimatedError();
    const std::vector<float> limit = Limit(screen);
    benchmark.Judge(scene.Name, "noise after 32 still frames, against its limit",
      Difference(after32, limit, depth, all), .006,
      "32 frames of one step, 1024 samples per pixel, unfiltered from 150 on; windows take as many "
      "steps as fit into a frame");
    table.Add(scene.Name, "converged, against its limit", Difference(converged, limit, depth, all),
      TargetKind::AtMost, .01,
      "estimated error of the worst tile of 16x16 pixels: " + std::to_string(estimated));
    table.Add(scene.Name, "change once converged", change, TargetKind::AtMost, 0.0);

    // A quarter of a degree per frame.
    Start(screen, scene.Radius);
    Reprojection followed(OcclusionWindow::Size[0], OcclusionWindow::Size[1]);
    for (int frame = 0; frame < MovingFrames; ++frame)
    {
      scene.Renderer->GetActiveCamera()->Azimuth(.25);
      screen.Draw();
      if (frame >= MovingFrames - FollowedFrames)
      {
        followed.Add(scene.Renderer->GetActiveCamera(), screen.Array("AmbientOcclusion"),
          screen.Array("Depth"));
      }
    }
    const std::vector<float> moving = screen.Array("AmbientOcclusion");
    const std::vector<float> movedDepth = screen.Array("Depth");
    benchmark.Judge(scene.Name, "moving: standard deviation at points of the surface, 8 frames",
      followed.StandardDeviation(), .0015,
      "the occluders in a single depth layer change with the view; fewer new samples per frame "
      "would be more stable, but slower to adapt");
    const double movingError = Difference(moving, Limit(screen), movedDepth, all);
    benchmark.Judge(scene.Name, "moving .25 degree a frame, against its limit", movingError, .02,
      "next to silhouettes the history contains the last 15 degrees; a shorter history has the "
      "same error by "
      "noise");

    // After a jump, disoccluded pixels start without history.
    Start(screen, scene.Radius);
    for (int frame = 0; frame < 16; ++frame)
    {
      screen.Draw();
    }
    scene.Renderer->GetActiveCamera()->Azimuth(4.0);
    screen.Draw();
    const std::vector<float> convergence = screen.Array("Convergence");
    const std::vector<float> after1 = screen.Array("AmbientOcclusion");
    for (int frame = 1; frame < 4; ++frame)
    {
      screen.Draw();
    }
    const std::vector<float> after4 = screen.Array("AmbientOcclusion");
    const std::vector<float> jumpedDepth = screen.Array("Depth");
    if (benchmark.Diagnose)
    {
      const std::string path = benchmark.Output + "/" + scene.Name;
      WriteImage(path + "-moving.png", moving);
      WriteImage(path + "-convergence.png", convergence); // black: fully converged
      WriteImage(path + "-jumped.png", after4);
    }
    const std::vector<float> jumpedLimit = Limit(screen);
    const float fresh = (static_cast<float>(screen.Ours->GetConstants().FirstSamples) + .5f) /
      static_cast<float>(screen.Ours->GetConstants().MaximumWeight);
    const auto disoccluded = [&](std::size_t i) { return convergence[i] <= fresh; };
    benchmark.Judge(scene.Name, "disoccluded pixels after 1 frame, against their limit",
      Difference(after1, jumpedLimit, jumpedDepth, disoccluded), 1.5 * movingError,
      "32 samples and a filter of 5 x 5 pixels; at most 1.5 times the settled moving error");
    benchmark.Judge(scene.Name, "disoccluded pixels after 4 frames, against their limit",
      Difference(after4, jumpedLimit, jumpedDepth, disoccluded), .03,
      "32 samples and a filter of 5 x 5 pixels, fewer next to silhouettes");
  }
}

}
