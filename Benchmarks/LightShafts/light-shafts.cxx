// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Prints the figures that light shafts have to reach, each beside its bar. Run it by
// `./penumbra benchmark light-shafts`.
#include "Benchmark.h"

#include "vtkVersion.h"

#include <cstdio>
#include <ctime>
#include <exception>

namespace
{

std::vector<std::string> Circumstances()
{
  char date[16];
  const std::time_t now = std::time(nullptr);
  std::strftime(date, sizeof date, "%Y-%m-%d", std::gmtime(&now));
  return { "OSMesa, one thread; date: " + std::string(date),
    "VTK " + std::string(vtkVersion::GetVTKVersion()) + ", compiler " __VERSION__,
    "truth of the pass: the ray caster's marched reference, 256 steps; of that: the closed form",
    "changes of light are of sources of intensity 1, in 1/255" };
}

}

int main(int argc, char** argv)
{
  using namespace penumbra;
  ShaftBenchmark benchmark;
  std::string only;
  bool usage = argc < 2;
  for (int i = 1; i < argc; ++i)
  {
    const std::string option = argv[i];
    std::string* value = option == "--output" ? &benchmark.Output
      : option == "--povray"                  ? &benchmark.PovRay
      : option == "--only"                    ? &only
                                              : nullptr;
    if (value && i + 1 < argc)
    {
      *value = argv[++i];
    }
    else if (option == "--diagnose")
    {
      benchmark.Diagnose = true;
    }
    else
    {
      usage = true;
    }
  }
  if (usage || benchmark.Output.empty())
  {
    std::fprintf(stderr,
      "usage: penumbra-benchmark-light-shafts --output FOLDER [--povray PROGRAM]\n"
      "         [--only marched|accuracy|cost|motion] [--diagnose]\n");
    return 2;
  }
  try
  {
    const auto chosen = [&](const char* part) { return only.empty() || only == part; };
    if (chosen("marched"))
    {
      MeasureMarched(benchmark);
    }
    if (chosen("accuracy"))
    {
      MeasureAccuracy(benchmark);
    }
    if (chosen("cost"))
    {
      MeasureCost(benchmark);
    }
    if (chosen("motion"))
    {
      MeasureMotion(benchmark);
    }
  }
  catch (const std::exception& problem)
  {
    std::fprintf(stderr, "penumbra-benchmark-light-shafts: %s\n", problem.what());
    return 2;
  }
  benchmark.Results.Write(
    benchmark.Output + "/light-shafts", "Light shafts: figures and bars", Circumstances());
  return benchmark.Results.GetMissed().empty() ? 0 : 1;
}
