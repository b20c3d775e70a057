// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"

#include "vtkPenumbraKernels.h"

#include <cmath>
#include <map>

namespace penumbra
{

namespace
{

/// The volumetric kernel treats points that are not visible from the camera as occluded. Where this
/// holds for 99 of 100 points, the kernel estimates its own D.
void AddRestrictedBias(OcclusionBenchmark& benchmark, const OcclusionTestScene& scene,
  const OcclusionTruth& truth, const std::vector<float>& image)
{
  const std::vector<float> misjudged =
    TraceMisjudged(scene.Renderer, OcclusionWindow::Size, scene.Radius, benchmark.Stride, 16);
  OcclusionTruth fair;
  double bias = 0.0;
  for (std::size_t i = 0; i < misjudged.size(); ++i)
  {
    if (misjudged[i] <= .01f)
    {
      fair.Pixels.push_back(truth.Pixels[i]);
      fair.Linear.push_back(truth.Linear[i]);
      bias += static_cast<double>(image[truth.Pixels[i]]) - truth.Linear[i];
    }
  }
  const double count = static_cast<double>(fair.Pixels.size());
  ResultTable& table = benchmark.Results;
  table.Add(scene.Name, "share of pixels where the eye judges as the surface does",
    count / static_cast<double>(misjudged.size()), TargetKind::None, 0.0, "at 99 % of 256 points");
  benchmark.Judge(scene.Name, "bias of volumetric there, D = 1 - t/R", std::abs(bias / count), .02,
    "the tangent plane is known to the precision of a pixel");
  table.Add(
    scene.Name, "RMSE of volumetric there", Rmse(fair, Falloff::Linear, image), TargetKind::None);
}

}

void MeasureAccuracy(OcclusionBenchmark& benchmark)
{
  const std::map<std::string, double> limits = { { "Scans", .045 }, { "S400", .065 },
    { "Sticks", .085 } };
  for (const OcclusionTestScene& scene : benchmark.Scenes())
  {
    const OcclusionTruth& truth = benchmark.TruthOf(scene);
    OcclusionWindow screen(scene.Renderer);
    screen.UseVTKSSAOPass(scene.Radius, 256);
    screen.Draw();
    const std::vector<float> peer = screen.OcclusionFromBrightness();
    benchmark.Results.Add(scene.Name, "RMSE of vtkSSAOPass, 256 samples",
      Rmse(truth, Falloff::Constant, peer), TargetKind::None);
    for (int kernel = 0; kernel < vtkPenumbraKernels::GetNumberOfKernels(); ++kernel)
    {
      const std::string name = vtkPenumbraKernels::GetName(kernel);
      const std::string falloff = vtkPenumbraKernels::GetFalloff(kernel);
      screen.UsePenumbraPass(scene.Radius)->SetKernelName(name.c_str());
      screen.Ours->SetConvergeInOneRender(vtkPenumbraTemporalSSAOPass::ALWAYS);
      screen.Draw();
      const std::vector<float> image = screen.Array("AmbientOcclusion");
      const bool linear = falloff == "1 - t";
      const double error = Rmse(truth, linear ? Falloff::Linear : Falloff::Constant, image);
      const std::string quantity = "RMSE of " + name + (linear ? ", D = 1 - t/R" : "");
      if (name == "march" || name == "horizon") // the kernels whose cost has a target
      {
        benchmark.Judge(scene.Name, quantity, error, limits.at(scene.Name),
          "a single depth layer does not contain the thickness of objects");
      }
      else
      {
        benchmark.Results.Add(scene.Name, quantity, error, TargetKind::None, 0.0,
          falloff.empty() ? "best gain " + std::to_string(Gain(truth, Falloff::Constant, image))
                          : "");
      }
      if (name == "volumetric")
      {
        AddRestrictedBias(benchmark, scene, truth, image);
      }
      if (benchmark.Diagnose)
      {
        WriteImage(benchmark.Output + "/" + scene.Name + "-" + name + ".png", image);
      }
    }
    if (benchmark.Diagnose)
    {
      WriteImage(benchmark.Output + "/" + scene.Name + "-vtkSSAOPass.png", peer);
    }
  }
}

}
