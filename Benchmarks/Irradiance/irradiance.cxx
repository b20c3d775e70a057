// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Prints the figures that the irradiance cache has to reach, each beside its bar. Run it by
// `./penumbra benchmark irradiance`, which also fetches what it needs.
#include "Benchmark.h"

#include "vtkSMPTools.h"
#include "vtkVersion.h"

#include <cstdio>
#include <exception>

namespace
{

std::vector<std::string> Circumstances()
{
  char date[16];
  const std::time_t now = std::time(nullptr);
  std::strftime(date, sizeof date, "%Y-%m-%d", std::gmtime(&now));
  return { "one thread, CPU seconds; date: " + std::string(date),
    "VTK " + std::string(vtkVersion::GetVTKVersion()) + ", compiler " __VERSION__,
    "spheres: default settings, tolerance .005, all pixels of 1024 x 1024 that are more than 2 "
    "pixels from the sphere's outline",
    "brute force: every 16th pixel in both directions or every 400th point, a ladder of tolerances "
    "read at the cache's own error",
    "not measured here: Radiance, pymeshlab and mitsuba" };
}

}

int main(int argc, char** argv)
{
  using namespace penumbra;
  IrradianceBenchmark benchmark;
  std::string only;
  bool usage = argc < 2;
  for (int i = 1; i < argc; ++i)
  {
    const std::string option = argv[i];
    std::string* value = option == "--meshes" ? &benchmark.Meshes
      : option == "--output"                  ? &benchmark.Output
      : option == "--only"                    ? &only
                                              : nullptr;
    if (value && i + 1 < argc)
    {
      *value = argv[++i];
    }
    else
    {
      usage = true;
    }
  }
  if (usage || benchmark.Meshes.empty() || benchmark.Output.empty())
  {
    std::fprintf(stderr,
      "usage: penumbra-benchmark-irradiance --meshes FOLDER --output FOLDER\n"
      "         [--only spheres|baking|records]\n");
    return 2;
  }
  vtkSMPTools::Initialize(1);
  try
  {
    const auto chosen = [&](const char* part) { return only.empty() || only == part; };
    if (chosen("spheres"))
    {
      MeasureSpheres(benchmark);
    }
    if (chosen("baking"))
    {
      MeasureBaking(benchmark);
    }
    if (chosen("records"))
    {
      MeasureRecords(benchmark);
    }
  }
  catch (const std::exception& problem)
  {
    std::fprintf(stderr, "penumbra-benchmark-irradiance: %s\n", problem.what());
    return 2;
  }
  benchmark.Results.Write(
    benchmark.Output + "/irradiance", "Irradiance cache: figures and bars", Circumstances());
  return benchmark.Results.GetMissed().empty() ? 0 : 1;
}
