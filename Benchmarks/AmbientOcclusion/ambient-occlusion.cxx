// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Prints the figures that ambient occlusion in OpenGL pictures has to reach, each beside its bar. Run
// it by `./penumbra benchmark ambient-occlusion`, which also fetches what it needs.
#include "Benchmark.h"

#include "vtkVersion.h"

#include <cstring>
#include <ctime>
#include <exception>
#include <iostream>

namespace
{

using penumbra::OcclusionBenchmark;

struct Part
{
  const char* Name;
  void (*Measure)(OcclusionBenchmark&);
};

const Part Parts[] = {
  { "accuracy", penumbra::MeasureAccuracy },
  { "cost", penumbra::MeasureCost },
  { "noise", penumbra::MeasureNoise },
  { "traced", penumbra::MeasureTraced },
};

std::vector<std::string> Circumstances(const OcclusionBenchmark& benchmark)
{
  char date[16];
  const std::time_t now = std::time(nullptr);
  std::strftime(date, sizeof date, "%Y-%m-%d", std::gmtime(&now));
  return { "OSMesa, one thread; 1024x768; date: " + std::string(date),
    "VTK " + std::string(vtkVersion::GetVTKVersion()) + ", compiler " __VERSION__,
    "truth: " + std::to_string(benchmark.Rays * benchmark.Rays) + " rays at every " +
      std::to_string(benchmark.Stride) + "th foreground pixel in both directions" };
}

}

int main(int argc, char** argv)
{
  OcclusionBenchmark benchmark;
  std::string only;
  for (int i = 1; i < argc; ++i)
  {
    const auto is = [&](const char* name) { return std::strcmp(argv[i], name) == 0; };
    if (is("--diagnose"))
    {
      benchmark.Diagnose = true;
    }
    else if (i + 1 < argc && (is("--meshes") || is("--output") || is("--only")))
    {
      (is("--meshes") ? benchmark.Meshes : is("--output") ? benchmark.Output : only) = argv[i + 1];
      ++i;
    }
    else
    {
      std::cerr << "ambient-occlusion: " << argv[i]
                << " is not one of --meshes, --output, --only, --diagnose\n";
      return 2;
    }
  }
  try
  {
    for (const Part& part : Parts)
    {
      if (only.empty() || only == part.Name)
      {
        part.Measure(benchmark);
      }
    }
  }
  catch (const std::exception& problem)
  {
    std::cerr << "ambient-occlusion: " << problem.what() << "\n";
    return 2;
  }
  benchmark.Results.Write(benchmark.Output + "/ambient-occlusion",
    "Ambient occlusion in OpenGL pictures: figures and bars", Circumstances(benchmark));
  for (const std::string& missed : benchmark.Results.GetMissed())
  {
    std::cout << "missed: " << missed << "\n";
  }
  return 0;
}
