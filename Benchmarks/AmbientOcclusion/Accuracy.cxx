// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"

#include "vtkPenumbraKernels.h"

#include <map>

namespace penumbra
{

void MeasureAccuracy(OcclusionBenchmark& benchmark)
{
  const std::map<std::string, double> bars = { { "Scans", .045 }, { "S400", .065 },
    { "Sticks", .085 } };
  for (const SceneUnderOcclusion& scene : benchmark.Scenes())
  {
    const OcclusionTruth truth =
      TraceOcclusion(scene.Renderer, Screen::Size, scene.Radius, benchmark.Stride, benchmark.Rays);
    Screen screen(scene.Renderer);
    screen.UseVtks(scene.Radius, 256);
    screen.Draw();
    const std::vector<float> peer = screen.Darkness();
    benchmark.Results.Add(scene.Name, "RMSE of vtkSSAOPass, 256 samples",
      Rmse(truth, FallOff::Constant, peer), Bar::None);
    for (int kernel = 0; kernel < vtkPenumbraKernels::GetNumberOfKernels(); ++kernel)
    {
      const std::string name = vtkPenumbraKernels::GetName(kernel);
      const std::string fallOff = vtkPenumbraKernels::GetFallOff(kernel);
      screen.UseOurs(scene.Radius)->SetKernelName(name.c_str());
      screen.Ours->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::ALWAYS);
      screen.Draw();
      const std::vector<float> picture = screen.Array("AmbientOcclusion");
      const bool linear = fallOff == "1 - t";
      const double error = Rmse(truth, linear ? FallOff::Linear : FallOff::Constant, picture);
      const bool judged = name == "march";
      benchmark.Results.Add(scene.Name, "RMSE of " + name + (linear ? ", D = 1 - t/R" : ""), error,
        judged ? Bar::AtMost : Bar::None, bars.at(scene.Name),
        fallOff.empty() ? "best gain " + std::to_string(Gain(truth, FallOff::Constant, picture))
                        : "");
      if (benchmark.Diagnose)
      {
        WritePicture(benchmark.Output + "/" + scene.Name + "-" + name + ".png", picture);
      }
    }
    if (benchmark.Diagnose)
    {
      WritePicture(benchmark.Output + "/" + scene.Name + "-vtkSSAOPass.png", peer);
    }
  }
}

}
