// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Prints the figures that light shafts have to reach, each beside its bar. Run it by
// `./penumbra benchmark light-shafts`.
#include "Benchmark.h"
#include "Program.h"

int main(int argc, char** argv)
{
  using namespace penumbra;
  ShaftBenchmark benchmark;
  Program program;
  program.Name = "light-shafts";
  program.Title = "Light shafts: figures and bars";
  program.Usage = "--output FOLDER [--povray PROGRAM] [--mitsuba PYTHON]\n"
                  "         [--only marched|accuracy|chained|cost|motion] [--diagnose]";
  program.Values = { { "--output", &benchmark.Output, true }, { "--povray", &benchmark.PovRay },
    { "--mitsuba", &benchmark.Mitsuba } };
  program.Switches = { { "--diagnose", &benchmark.Diagnose } };
  program.Parts = {
    { "marched", [&] { MeasureMarched(benchmark); } },
    { "accuracy", [&] { MeasureAccuracy(benchmark); } },
    { "chained", [&] { MeasureChained(benchmark); } },
    { "cost", [&] { MeasureCost(benchmark); } },
    { "motion", [&] { MeasureMotion(benchmark); } },
  };
  return program.Run(argc, argv, benchmark.Results, benchmark.Output, [] {
    return std::vector<std::string>{ "OSMesa, one thread; " + DateLine(), VersionLine(),
      "truth of the pass: the ray caster's marched reference, 256 steps; of that: the closed form",
      "changes of light are of sources of intensity 1, in 1/255" };
  });
}
