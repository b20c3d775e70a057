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

struct Bars
{
  double First;
  double Later;
};

/// One ray a pixel and frame.
vtkPenumbraTemporalSSAOPass* UseRays(Screen& screen, double radius)
{
  vtkPenumbraTemporalSSAOPass* pass = screen.UseOurs(radius);
  pass->SetKernelName("traced");
  pass->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::NEVER);
  return pass;
}

/// The shortest of several frames, each from a slightly other place: nothing is kept but history.
double FrameTime(Screen& screen, vtkRenderer* renderer)
{
  screen.Draw();
  double shortest = screen.Draw();
  for (int i = 0; i < Repetitions; ++i)
  {
    renderer->GetActiveCamera()->Azimuth(i % 2 ? .05 : -.05);
    shortest = std::min(shortest, screen.Draw());
  }
  renderer->GetActiveCamera()->Azimuth(.05);
  return shortest;
}

}

void MeasureTraced(OcclusionBenchmark& benchmark)
{
  const std::map<std::string, Bars> bars = { { "Scans", { .040, .012 } },
    { "S400", { .065, .020 } }, { "Sticks", { .050, .015 } } };
  vtkPenumbraTracedEstimator::Register();
  vtkSMPTools::Initialize(1);
  for (const SceneUnderOcclusion& scene : benchmark.Scenes())
  {
    const OcclusionTruth& truth = benchmark.TruthOf(scene);
    Screen screen(scene.Renderer);
    UseRays(screen, scene.Radius);
    const double withTree = screen.Draw();
    for (int frame = 1; frame <= Frames; ++frame)
    {
      const std::vector<float> picture = screen.Array("AmbientOcclusion");
      const double error = Rmse(truth, FallOff::Constant, picture);
      if (frame == 1)
      {
        benchmark.Judge(scene.Name, "RMSE of traced, first frame", error, bars.at(scene.Name).First,
          "the filter of 5 x 5 pixels has few neighbours on a thing some pixels wide");
      }
      else if (frame == 4)
      {
        benchmark.Results.Add(scene.Name, "RMSE of traced, after 4 frames", error, Bar::None);
      }
      else if (frame == Frames)
      {
        benchmark.Judge(scene.Name, "RMSE of traced, after 16 frames", error,
          bars.at(scene.Name).Later,
          "16 rays a pixel, and few neighbours on things some pixels wide");
      }
      if (benchmark.Diagnose && (frame == 1 || frame == Frames))
      {
        WritePicture(
          benchmark.Output + "/" + scene.Name + "-traced-" + std::to_string(frame) + ".png",
          picture);
      }
      screen.Draw();
    }
    screen.UseOurs(scene.Radius)->SetKernelName("traced");
    screen.Draw();
    benchmark.Results.Add(scene.Name, "RMSE of traced, converged",
      Rmse(truth, FallOff::Constant, screen.Array("AmbientOcclusion")), Bar::None);

    screen.UseNone();
    const double plain = FrameTime(screen, scene.Renderer);
    UseRays(screen, scene.Radius);
    const double traced = FrameTime(screen, scene.Renderer);
    screen.UseVtks(scene.Radius, 32);
    const double peer = FrameTime(screen, scene.Renderer);
    benchmark.Judge(scene.Name, "overhead of traced / of vtkSSAOPass 32",
      (traced - plain) / (peer - plain), .40,
      "a second ray a pixel finds the surface exactly; both are traced on the drawing thread");
    benchmark.Results.Add(scene.Name, "plain frame, s", plain, Bar::None);
    benchmark.Results.Add(scene.Name, "frame with traced, s", traced, Bar::None);
    benchmark.Results.Add(
      scene.Name, "frame with traced that builds the tree, s", withTree, Bar::None);
    benchmark.Results.Add(scene.Name, "frame with vtkSSAOPass 32, s", peer, Bar::None);
  }
}

}
