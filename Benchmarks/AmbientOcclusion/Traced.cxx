// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"

#include "vtkPenumbraTracedEstimator.h"

#include "vtkCamera.h"
#include "vtkRenderer.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <map>

namespace penumbra
{

namespace
{

constexpr int Frames = 16;
constexpr int Repetitions = 5;

/// Camera rotation between timed frames, degrees.
constexpr double Turn = .05;

/// Upper limits of the RMSE of a static view.
struct ErrorLimits
{
  double FirstFrame;
  double LastFrame; ///< after all `Frames`
};

/// One ray per pixel and frame; in motion, one for four pixels.
vtkPenumbraTemporalSSAOPass* UseRays(OcclusionWindow& screen, double radius)
{
  vtkPenumbraTemporalSSAOPass* pass = screen.UsePenumbraPass(radius);
  pass->SetKernelName("traced");
  pass->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
  return pass;
}

/// Returns the time of the fastest of several frames, each rotated by the given number of degrees
/// in alternating directions. After any rotation, only the history is reused.
double FrameTime(OcclusionWindow& screen, vtkRenderer* renderer, double degrees)
{
  screen.Draw();
  double shortest = screen.Draw();
  for (int i = 0; i < Repetitions; ++i)
  {
    renderer->GetActiveCamera()->Azimuth(i % 2 ? degrees : -degrees);
    shortest = std::min(shortest, screen.Draw());
  }
  renderer->GetActiveCamera()->Azimuth(degrees);
  return shortest;
}

/// Renders the view at the camera's position after approaching it in steps of a quarter of a
/// degree.
std::vector<float> MoveCameraToStart(OcclusionWindow& screen, const OcclusionTestScene& scene)
{
  UseRays(screen, scene.Radius);
  scene.Renderer->GetActiveCamera()->Azimuth(-.25 * Frames);
  screen.Draw();
  for (int frame = 0; frame < Frames; ++frame)
  {
    scene.Renderer->GetActiveCamera()->Azimuth(.25);
    screen.Draw();
  }
  return screen.Array("AmbientOcclusion");
}

}

void MeasureTraced(OcclusionBenchmark& benchmark)
{
  const std::map<std::string, ErrorLimits> limits = { { "Scans", { .040, .012 } },
    { "S400", { .065, .020 } }, { "Sticks", { .050, .015 } } };
  vtkPenumbraTracedEstimator::Register();
  vtkSMPTools::Initialize(1);
  for (const OcclusionTestScene& scene : benchmark.Scenes())
  {
    const OcclusionTruth& truth = benchmark.TruthOf(scene);
    OcclusionWindow screen(scene.Renderer);
    UseRays(screen, scene.Radius);
    const double withTree = screen.Draw();
    for (int frame = 1; frame <= Frames; ++frame)
    {
      const std::vector<float> image = screen.Array("AmbientOcclusion");
      const double error = Rmse(truth, Falloff::Constant, image);
      if (frame == 1)
      {
        benchmark.Judge(scene.Name, "RMSE of traced, first frame", error,
          limits.at(scene.Name).FirstFrame,
          "the filter of 5 x 5 pixels has few neighbors on objects a few pixels wide");
      }
      else if (frame == 4)
      {
        benchmark.Results.Add(
          scene.Name, "RMSE of traced, after 4 frames", error, TargetKind::None);
      }
      else if (frame == Frames)
      {
        benchmark.Judge(scene.Name, "RMSE of traced, after 16 frames", error,
          limits.at(scene.Name).LastFrame,
          "16 rays per pixel, and few neighbors on objects a few pixels wide");
      }
      if (benchmark.Diagnose && (frame == 1 || frame == Frames))
      {
        WriteImage(
          benchmark.Output + "/" + scene.Name + "-traced-" + std::to_string(frame) + ".png", image);
      }
      screen.Draw();
    }
    screen.UsePenumbraPass(scene.Radius)->SetKernelName("traced");
    screen.Draw();
    benchmark.Results.Add(scene.Name, "RMSE of traced, converged",
      Rmse(truth, Falloff::Constant, screen.Array("AmbientOcclusion")), TargetKind::None);

    benchmark.Results.Add(scene.Name, "RMSE of traced, after 16 frames in motion",
      Rmse(truth, Falloff::Constant, MoveCameraToStart(screen, scene)), TargetKind::None);

    screen.UseNone();
    const double plain = FrameTime(screen, scene.Renderer, Turn);
    UseRays(screen, scene.Radius);
    const double traced = FrameTime(screen, scene.Renderer, Turn);
    const double still = FrameTime(screen, scene.Renderer, 0.0);
    screen.UseVTKSSAOPass(scene.Radius, 32);
    const double peer = FrameTime(screen, scene.Renderer, Turn);
    benchmark.Judge(scene.Name, "overhead of traced, moving / of vtkSSAOPass 32",
      (traced - plain) / (peer - plain), .40,
      "one pixel of four is traced: its surface point and its ray are a third of the cost; the "
      "rest reads depths back, reprojects the history, filters and composites");
    benchmark.Judge(scene.Name, "overhead of traced, still / of vtkSSAOPass 32",
      (still - plain) / (peer - plain), .40,
      "a ray for every pixel, on the rendering thread, is half of the cost; the rest filters and "
      "composites");
    benchmark.Results.Add(scene.Name, "plain frame, s", plain, TargetKind::None);
    benchmark.Results.Add(scene.Name, "moving frame with traced, s", traced, TargetKind::None);
    benchmark.Results.Add(scene.Name, "still frame with traced, s", still, TargetKind::None);
    benchmark.Results.Add(
      scene.Name, "frame with traced that builds the tree, s", withTree, TargetKind::None);
    benchmark.Results.Add(scene.Name, "frame with vtkSSAOPass 32, s", peer, TargetKind::None);
  }
}

}
