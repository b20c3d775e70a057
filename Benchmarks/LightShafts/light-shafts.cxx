// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Measures the light shafts and compares each result with its target. Run it with `./penumbra
// benchmark light-shafts`.
#include "Benchmark.h"
#include "Occlusion/FrameClock.h"
#include "Program.h"

int main(int argc, char** argv)
{
  using namespace penumbra;
  ShaftBenchmark benchmark;
  Program program;
  program.Name = "light-shafts";
  program.Title = "Light shafts: measurements and targets";
  program.Usage = "--output FOLDER [--povray PROGRAM] [--mitsuba PYTHON]\n"
                  "         [--only marched|accuracy|chained|cost|motion] [--diagnose] [--elapsed]";
  program.Values = { { "--output", &benchmark.Output, true }, { "--povray", &benchmark.PovRay },
    { "--mitsuba", &benchmark.Mitsuba } };
  program.Switches = { { "--diagnose", &benchmark.Diagnose }, { "--elapsed", &FramesAreElapsed } };
  program.Parts = {
    { "marched", [&] { MeasureMarched(benchmark); } },
    { "accuracy", [&] { MeasureAccuracy(benchmark); } },
    { "chained", [&] { MeasureChained(benchmark); } },
    { "cost", [&] { MeasureCost(benchmark); } },
    { "motion", [&] { MeasureMotion(benchmark); } },
  };
  return program.Run(argc, argv, benchmark.Results, benchmark.Output, [] {
    return std::vector<std::string>{ "one thread, " + DescribeFrameClock(),
      "reference of the pass: the ray caster's marched reference, 256 steps; its own reference: "
      "the closed form",
      "moving light and occluder: radiance is a fraction of the maximum, that of an infinitely "
      "long, "
      "lit ray" };
  });
}
