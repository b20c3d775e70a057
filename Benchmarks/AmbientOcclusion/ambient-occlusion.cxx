// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Measures the ambient occlusion of OpenGL images and compares each result with its target. Run it
// with `./penumbra benchmark ambient-occlusion`, which also fetches the meshes.
#include "Benchmark.h"
#include "FrameClock.h"
#include "Program.h"

#include <iostream>

int main(int argc, char** argv)
{
  using namespace penumbra;
  OcclusionBenchmark benchmark;
  Program program;
  program.Name = "ambient-occlusion";
  program.Title = "Ambient occlusion in OpenGL images: measurements and targets";
  program.Usage = "--meshes FOLDER --output FOLDER\n"
                  "         [--only accuracy|memory|cost|noise|ranks|settling|traced|turns] "
                  "[--scene NAME] [--diagnose] [--elapsed]";
  program.Values = { { "--meshes", &benchmark.Meshes, true },
    { "--output", &benchmark.Output, true }, { "--scene", &benchmark.Scene, false } };
  program.Switches = { { "--diagnose", &benchmark.Diagnose }, { "--elapsed", &FramesAreElapsed } };
  program.Parts = {
    { "accuracy", [&] { MeasureAccuracy(benchmark); } },
    { "memory", [&] { MeasureMemory(benchmark); } },
    { "cost", [&] { MeasureCost(benchmark); } },
    { "noise", [&] { MeasureNoise(benchmark); } },
    { "ranks", [&] { MeasureRanks(benchmark); } },
    { "settling", [&] { MeasureSettling(benchmark); } },
    { "traced", [&] { MeasureTraced(benchmark); } },
    { "turns", [&] { MeasureTurns(benchmark); } },
  };
  const int status = program.Run(argc, argv, benchmark.Results, benchmark.Output, [&] {
    return std::vector<std::string>{ "one thread, " + DescribeFrameClock() + "; 1024x768",
      "reference: " + std::to_string(benchmark.Rays * benchmark.Rays) + " rays at every " +
        std::to_string(benchmark.Stride) + "th foreground pixel in both directions" };
  });
  for (const std::string& missed : benchmark.Results.GetFailed())
  {
    std::cout << "missed: " << missed << "\n";
  }
  return status;
}
