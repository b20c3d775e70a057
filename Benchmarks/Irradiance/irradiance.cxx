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
  program.Usage = "--meshes FOLDER --output FOLDER\n"
                  "         [--only spheres|forms|light|baking|records]";
  program.Values = { { "--meshes", &benchmark.Meshes, true },
    { "--output", &benchmark.Output, true } };
  program.Parts = {
    { "spheres", [&] { MeasureSpheres(benchmark); } },
    { "forms", [&] { MeasureForms(benchmark); } },
    { "light", [&] { MeasureLight(benchmark); } },
    { "baking", [&] { MeasureBaking(benchmark); } },
    { "records", [&] { MeasureRecords(benchmark); } },
  };
  vtkSMPTools::Initialize(1);
  return program.Run(argc, argv, benchmark.Results, benchmark.Output, [] {
    return std::vector<std::string>{ "one thread, CPU seconds; " + DateLine(), VersionLine(),
      "spheres: default settings, tolerance .005, all pixels of 1024 x 1024 that are more than 2 "
      "pixels from the sphere's outline",
      "brute force: every 16th pixel in both directions or every 400th point, a ladder of "
      "tolerances read at the cache's own error",
      "not measured here, the programs not being at hand: Radiance's time (bars: 1/3 of it on the "
      "spheres, 1/2 in the box), pymeshlab's on the scan (bar: 1/5), mitsuba; the cube-map "
      "gatherer "
      "does not exist" };
  });
}
