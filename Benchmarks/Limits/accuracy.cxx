// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Accuracy of images and of their error estimates in scenes that were not used to choose constants:
// fraction of tiles above the tolerance, fraction of these whose estimate is below their error, and
// ratio of estimate and error. With --uniform, also the rays of uniform sampling with the same error.
#include "BruteForce/ImageErrors.h"
#include "BruteForce/StratifiedReference.h"
#include "Scenes/AccuracyScenes.h"

#include "vtkNew.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

using namespace penumbra;

namespace
{

struct Options
{
  std::string Only;
  double InverseTolerance = 256.0;
  int ReferenceSide = 24;
  bool Uniform = false;
};

struct Accuracy
{
  double AboveTolerance = 0.0; ///< fraction of tiles
  double Misjudged = 0.0;      ///< fraction of these with an estimate below their error
  double MedianRatio = 0.0;    ///< of estimate and error
  double Error = 0.0;          ///< RMSE of the image
};

Accuracy Summarize(const std::vector<TileAccuracy>& tiles, double tolerance)
{
  Accuracy accuracy;
  std::vector<double> ratios;
  double squares = 0.0;
  for (const TileAccuracy& tile : tiles)
  {
    const bool above = tile.Error > tolerance;
    accuracy.AboveTolerance += above ? 1.0 : 0.0;
    accuracy.Misjudged += above && tile.Estimate < tile.Error ? 1.0 : 0.0;
    squares += tile.Error * tile.Error;
    if (tile.Error > 0.05 * tolerance)
    {
      ratios.push_back(tile.Estimate / tile.Error);
    }
  }
  const auto count = static_cast<double>(tiles.size());
  accuracy.AboveTolerance /= count;
  accuracy.Misjudged /= count;
  accuracy.Error = std::sqrt(squares / count);
  if (!ratios.empty())
  {
    std::nth_element(ratios.begin(), ratios.begin() + ratios.size() / 2, ratios.end());
    accuracy.MedianRatio = ratios[ratios.size() / 2];
  }
  return accuracy;
}

double ComputeUniformCost(vtkRenderer* renderer, const AccuracyScene& scene,
  const StratifiedReference& reference, double error, bool seconds)
{
  std::vector<glm::dvec2> ladder;
  for (const int n : { 1, 2, 3, 4, 6, 8, 12 })
  {
    const Answer answer =
      Cast(renderer, AccuracyImageSide, AccuracyImageSide, [&](vtkPenumbraRayCaster* caster) {
        caster->SetCoverageMethod(vtkPenumbraRayCaster::UNIFORM);
        caster->SetUniformSamples(n);
        caster->SetShadows(scene.Shadows);
      });
    const Accuracy accuracy =
      Summarize(CompareTiles(answer, reference, AccuracyImageSide), 1.0 / 256.0);
    ladder.emplace_back(accuracy.Error, seconds ? answer.Seconds : answer.RaysPerPixel);
  }
  return CostAtError(ladder, error);
}

void Measure(const AccuracyScene& scene, const Options& options, double& above, double& misjudged)
{
  vtkNew<vtkRenderer> renderer;
  scene.Build(renderer);
  constexpr int Side = AccuracyImageSide;
  const double tolerance = 1.0 / options.InverseTolerance;
  const Answer answer = Cast(renderer, Side, Side, [&](vtkPenumbraRayCaster* caster) {
    caster->SetTolerance(tolerance);
    caster->SetShadows(scene.Shadows);
  });
  const StratifiedReference reference =
    DrawStratified(renderer, Side, Side, options.ReferenceSide, scene.Shadows);
  const Accuracy accuracy = Summarize(CompareTiles(answer, reference, Side), tolerance);
  above += accuracy.AboveTolerance;
  misjudged += accuracy.Misjudged;
  std::printf("| %-22s | %5.1f | %5.1f | %5.2f | %.5f | %7.2f | %6.3f |", scene.Name.c_str(),
    100.0 * accuracy.AboveTolerance, 100.0 * accuracy.Misjudged, accuracy.MedianRatio,
    accuracy.Error, answer.RaysPerPixel, answer.Seconds);
  if (options.Uniform)
  {
    std::printf(" %8.2f |", ComputeUniformCost(renderer, scene, reference, accuracy.Error, false));
  }
  std::printf("\n");
  std::fflush(stdout);
}

}

int main(int count, char** arguments)
{
  Options options;
  for (int i = 1; i < count; ++i)
  {
    const std::string name = arguments[i];
    const char* value = i + 1 < count ? arguments[i + 1] : "";
    options.Uniform = options.Uniform || name == "--uniform";
    options.Only = name == "--only" ? value : options.Only;
    options.InverseTolerance =
      name == "--inverse-tolerance" ? std::atof(value) : options.InverseTolerance;
    options.ReferenceSide = name == "--reference" ? std::atoi(value) : options.ReferenceSide;
  }
  std::printf("Tolerance 1/%g, tiles of 16x16 pixels, %d reference samples per pixel\n\n",
    options.InverseTolerance, 2 * options.ReferenceSide * options.ReferenceSide);
  std::printf("| scene | tiles above the tolerance, %% | of all tiles, above and estimate below "
              "error, %% | median estimate / error | RMSE | rays per pixel | CPU s |%s\n",
    options.Uniform ? " rays of uniform samples with this error |" : "");
  std::printf("|---|---|---|---|---|---|---|%s\n", options.Uniform ? "---|" : "");
  double above = 0.0;
  double misjudged = 0.0;
  int scenes = 0;
  for (const AccuracyScene& scene : GetAccuracyScenes())
  {
    if (scene.Name.find(options.Only) != std::string::npos)
    {
      Measure(scene, options, above, misjudged);
      ++scenes;
    }
  }
  std::printf("\n%d scenes: %.1f %% of tiles above the tolerance, %.1f %% misjudged\n", scenes,
    100.0 * above / std::max(scenes, 1), 100.0 * misjudged / std::max(scenes, 1));
  return 0;
}
