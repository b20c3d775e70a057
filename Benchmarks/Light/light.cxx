// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Measures light from colored skies, emitters and lights with a size, and compares each result with its
// target. Run it with `./penumbra benchmark light`.
#include "Benchmark.h"
#include "Program.h"

#include "vtkNew.h"
#include "vtkPenumbraBruteForceIrradiance.h"
#include "vtkPenumbraIrradianceCache.h"
#include "vtkSMPTools.h"

#include <cstdio>

namespace penumbra
{

std::string Brief(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

vtkSmartPointer<vtkPenumbraIrradianceProvider> MakeProvider(const std::string& name, bool isLight)
{
  if (name == "cache" || name == "automatic" || (name.empty() && isLight))
  {
    auto cache = vtkSmartPointer<vtkPenumbraIrradianceCache>::New();
    cache->SetJoinPixels(name != "cache");
    return cache;
  }
  vtkNew<vtkPenumbraBruteForceIrradiance> rays;
  rays->SetJoinPixels(name != "brute-force");
  return rays;
}

}

int main(int argc, char** argv)
{
  using namespace penumbra;
  LightBenchmark benchmark;
  Program program;
  program.Name = "light";
  program.Title = "Light: measurements and targets";
  program.Usage = "--data FOLDER --output FOLDER [--povray PROGRAM] [--width N] [--mesh NAME] "
                  "[--inverse-tolerance N] [--provider automatic|joined|cache|brute-force] [--only "
                  "occlusion|indirect|skies|baking|emitters|box|panes|penumbrae|povray|f3d]";
  program.Values = { { "--data", &benchmark.Data, true }, { "--output", &benchmark.Output, true },
    { "--povray", &benchmark.PovRay }, { "--width", &benchmark.Width },
    { "--mesh", &benchmark.Mesh }, { "--inverse-tolerance", &benchmark.InverseTolerance },
    { "--provider", &benchmark.Provider } };
  program.Parts = {
    { "occlusion", [&] { MeasureOcclusion(benchmark); } },
    { "indirect", [&] { MeasureIndirect(benchmark); } },
    { "skies", [&] { MeasureSkies(benchmark); } },
    { "baking", [&] { MeasureBakedSkies(benchmark); } },
    { "emitters", [&] { MeasureEmitters(benchmark); } },
    { "box", [&] { MeasureBox(benchmark); } },
    { "panes", [&] { MeasurePanes(benchmark); } },
    { "penumbrae", [&] { MeasurePenumbrae(benchmark); } },
    { "povray", [&] { ComparePenumbrae(benchmark); } },
    { "f3d", [&] { CompareWithF3D(benchmark); } },
  };
  vtkSMPTools::Initialize(1);
  return program.Run(argc, argv, benchmark.Results, benchmark.Output, [] {
    return std::vector<std::string>{ "one thread, CPU seconds",
      "references: brute force with 16,384 rays per point; independent paths for emitters; closed "
      "forms "
      "for penumbrae",
      "skies: irradiance over pi times the albedo, as in an image; errors are RMSE over tiles of "
      "16 x 16 "
      "pixels, with 4 reference points each, per channel; a tile fails if one channel fails",
      "baked: RMSE per channel over 512 points, relative to the radiance of the sky; for the "
      "colored "
      "environment map and the sun, to its mean over the sphere" };
  });
}
