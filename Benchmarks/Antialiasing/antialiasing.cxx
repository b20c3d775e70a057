// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Measures the antialiasing and compares each result with its target. Run it with `./penumbra
// benchmark antialiasing`, which also fetches the meshes.
#include "Benchmark.h"
#include "Program.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numeric>

namespace penumbra
{
namespace
{

/// Writes |error| times 64 as an image, and prints the worst pixels.
void Diagnose(const Benchmark& benchmark, const std::string& scene, const Answer& answer,
  const std::vector<glm::dvec3>& truth, int width)
{
  const int height = static_cast<int>(truth.size()) / width;
  vtkNew<vtkImageData> image;
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* bytes = static_cast<unsigned char*>(image->GetScalarPointer());
  std::vector<double> worst(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    const glm::dvec3 error = glm::abs(answer.Colors[i] - truth[i]);
    worst[i] = std::max({ error.x, error.y, error.z });
    for (int c = 0; c < 3; ++c)
    {
      bytes[3 * i + c] = static_cast<unsigned char>(std::min(255.0, error[c] * 64.0 * 255.0));
    }
  }
  std::string name = benchmark.Output + "/" + scene;
  std::replace(name.begin() + benchmark.Output.size() + 1, name.end(), ' ', '-');
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName((name + "-error.png").c_str());
  writer->SetInputData(image);
  writer->Write();

  std::ofstream tiles(name + "-tiles.csv");
  tiles << "x,y,error,estimate\n";
  for (int y = 0; y < height; y += 16)
  {
    for (int x = 0; x < width; x += 16)
    {
      double error = 0.0;
      double estimate = 0.0;
      int count = 0;
      for (int k = 0; k < 256; ++k)
      {
        if (x + k % 16 < width && y + k / 16 < height)
        {
          const std::size_t i = static_cast<std::size_t>(y + k / 16) * width + x + k % 16;
          const glm::dvec3 difference = answer.Colors[i] - truth[i];
          error += glm::dot(difference, difference) / 3.0;
          estimate += answer.Estimates[i] * answer.Estimates[i];
          ++count;
        }
      }
      tiles << x << ',' << y << ',' << std::sqrt(error / count) << ','
            << std::sqrt(estimate / count) << '\n';
    }
  }

  std::vector<std::size_t> order(truth.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  const std::size_t count = std::min<std::size_t>(200, order.size());
  std::partial_sort(order.begin(), order.begin() + count, order.end(),
    [&](std::size_t a, std::size_t b) { return worst[a] > worst[b]; });
  std::ofstream list(name + "-worst.csv");
  list << "x,y,ours,truth,estimate\n";
  for (std::size_t k = 0; k < count; ++k)
  {
    const std::size_t i = order[k];
    list << i % width << ',' << i / width << ',' << answer.Colors[i].x << ',' << truth[i].x << ','
         << answer.Estimates[i] << '\n';
  }
}

void SumUpTiles(Benchmark& benchmark)
{
  if (benchmark.Estimates.Tiles > 0)
  {
    ResultTable& table = benchmark.Results;
    table.Add("tiles of all scenes", "share with estimate >= error",
      benchmark.Estimates.ConservativeFraction(), TargetKind::AtLeast, 0.95,
      std::to_string(benchmark.Estimates.Tiles) + " tiles");
    table.Add("tiles of all scenes", "median of estimate / error",
      benchmark.Estimates.MedianRatio(), TargetKind::AtMost, 3.0,
      std::to_string(benchmark.Estimates.Ratios.size()) + " tiles with an error above 1e-4");
  }
}

std::vector<std::string> Circumstances(const Benchmark& benchmark)
{
  return { "one thread",
    "peer: " + (benchmark.PovRay.empty() ? "none" : "POV-Ray, `" + benchmark.PovRay + "`"),
    "reference: exact coverage for flat shapes; " + std::to_string(benchmark.TruthSamples) + " x " +
      std::to_string(benchmark.TruthSamples) +
      " samples per pixel for lit meshes, 16 times as many on edges",
    "RMSE over RGB in [0, 1]; edge: over partly covered pixels of flat shapes, and over pixels "
    "of "
    "lit meshes that contain background and surface, or surfaces not connected within the pixel" };
}

}

Errors Judge(Benchmark& benchmark, const std::string& scene, const Answer& answer,
  const std::vector<glm::dvec3>& truth, const std::vector<bool>& isEdge, int width)
{
  ErrorCalibration own;
  AddTiles(own, answer.Colors, truth, answer.Estimates, width);
  std::printf("  %s: estimate >= error in %.1f %% of tiles, median estimate / error %.2f\n",
    scene.c_str(), 100.0 * own.ConservativeFraction(), own.MedianRatio());
  AddTiles(benchmark.Estimates, answer.Colors, truth, answer.Estimates, width);
  if (benchmark.Diagnose)
  {
    Diagnose(benchmark, scene, answer, truth, width);
  }
  return Compare(answer.Colors, truth, isEdge);
}

}

int main(int argc, char** argv)
{
  using namespace penumbra;
  Benchmark benchmark;
  Program program;
  program.Name = "antialiasing";
  program.Title = "Antialiasing: measurements and targets";
  program.Usage = "--meshes FOLDER --output FOLDER [--povray PROGRAM]\n"
                  "         [--only memory|flat|lit|dense|packets] [--diagnose] [--no-peers]";
  program.Values = { { "--meshes", &benchmark.Meshes, true },
    { "--output", &benchmark.Output, true }, { "--povray", &benchmark.PovRay } };
  program.Switches = { { "--diagnose", &benchmark.Diagnose },
    { "--no-peers", &benchmark.Peers, false } };
  program.Parts = {
    { "memory",
      [&] { MeasureMemory(benchmark); } }, // first, before anything else has used the heap
    { "flat", [&] { MeasureFlatShapes(benchmark); } },
    { "packets", [&] { MeasureBasePass(benchmark); } },
    { "dense", [&] { MeasureDenseMesh(benchmark); } },
    { "lit", [&] { MeasureLitMeshes(benchmark); } },
    { "", [&] { SumUpTiles(benchmark); } },
  };
  return program.Run(
    argc, argv, benchmark.Results, benchmark.Output, [&] { return Circumstances(benchmark); });
}
