// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Measures the irradiance cache and compares each result with its target. Run it with `./penumbra
// benchmark irradiance`, which also fetches the meshes.
#include "Benchmark.h"
#include "Program.h"

#include "vtkSMPTools.h"

int main(int argc, char** argv)
{
  using namespace penumbra;
  IrradianceBenchmark benchmark;
  Program program;
  program.Name = "irradiance";
  program.Title = "Irradiance cache: measurements and targets";
  program.Usage = "--meshes FOLDER --output FOLDER [--radiance PYTHON] [--meshlab PYTHON]\n"
                  "         [--only spheres|forms|light|baking|gatherers|records] [--elapsed]";
  program.Values = { { "--meshes", &benchmark.Meshes, true },
    { "--output", &benchmark.Output, true }, { "--radiance", &benchmark.Radiance },
    { "--meshlab", &benchmark.MeshLab } };
  program.Switches = { { "--elapsed", &FramesAreElapsed } };
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
    return std::vector<std::string>{ "one thread, " + DescribeFrameClock(),
      "spheres: default settings, tolerance 0.005, all pixels of 1024 x 1024 more than 2 "
      "pixels from the sphere's silhouette",
      "brute force: every 16th pixel in both directions or every 400th point, a series of "
      "tolerances, interpolated at the error of the cache",
      "Radiance and MeshLab: settings are in Benchmarks/Peers/scripts; CPU seconds "
      "of all "
      "their "
      "threads, without reading and acceleration structures",
      "cube maps: with OSMesa, the CPU time of its threads is included" };
  });
}
