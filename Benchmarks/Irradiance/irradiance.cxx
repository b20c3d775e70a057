// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Prints the figures that the irradiance cache has to reach, each beside its bar. Run it by
// `./penumbra benchmark irradiance`, which also fetches what it needs.
#include "Benchmark.h"
#include "Program.h"

#include "vtkSMPTools.h"

int main(int argc, char** argv)
{
  using namespace penumbra;
  IrradianceBenchmark benchmark;
  Program program;
  program.Name = "irradiance";
  program.Title = "Irradiance cache: figures and bars";
  program.Usage = "--meshes FOLDER --output FOLDER [--radiance PYTHON] [--meshlab PYTHON]\n"
                  "         [--only spheres|forms|light|baking|gatherers|records]";
  program.Values = { { "--meshes", &benchmark.Meshes, true },
    { "--output", &benchmark.Output, true }, { "--radiance", &benchmark.Radiance },
    { "--meshlab", &benchmark.MeshLab } };
  program.Parts = {
    { "spheres", [&] { MeasureSpheres(benchmark); } },
    { "forms", [&] { MeasureForms(benchmark); } },
    { "light", [&] { MeasureLight(benchmark); } },
    { "baking", [&] { MeasureBaking(benchmark); } },
    { "gatherers", [&] { MeasureGatherers(benchmark); } },
    { "records", [&] { MeasureRecords(benchmark); } },
  };
  vtkSMPTools::Initialize(1);
  return program.Run(argc, argv, benchmark.Results, benchmark.Output, [] {
    return std::vector<std::string>{ "one thread, CPU seconds; " + DateLine(), VersionLine(),
      "spheres: default settings, tolerance .005, all pixels of 1024 x 1024 that are more than 2 "
      "pixels from the sphere's outline",
      "brute force: every 16th pixel in both directions or every 400th point, a ladder of "
      "tolerances read at the cache's own error",
      "Radiance and MeshLab: what they are asked for is in Benchmarks/Peers/scripts; CPU seconds "
      "of all "
      "their "
      "threads, reading and trees left out",
      "cube maps: by OpenGL without a graphics card (llvmpipe), its threads counted" };
  });
}
