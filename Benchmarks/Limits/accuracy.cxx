// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Accuracy of images and of their error estimates in scenes that were not used to choose constants:
// fraction of tiles above the tolerance, fraction of these whose estimate is below their error,
// fraction of tiles that are reported but below it, and ratio of estimate and error. With --effect,
// the same with light effects. With --uniform, also the rays of uniform sampling with the same error.
// With --ordinary, time and accuracy of scenes as applications show them.
#include "BruteForce/ImageErrors.h"
#include "BruteForce/RandomLight.h"
#include "BruteForce/StratifiedReference.h"
#include "OrdinaryScenes.h"
#include "Program.h"
#include "Scenes/AccuracyScenes.h"

#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPenumbraMedium.h"
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraRayCasterConstants.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

using namespace penumbra;

namespace
{

struct Options
{
  std::string Only;
  double InverseTolerance = 256.0;
  int ReferenceSide = 24;
  bool Uniform = false;
  bool Ordinary = false;
  std::string Effect = "none";
};

/// A light effect that is added to every scene.
struct Effect
{
  std::string Name;
  bool NeedsLight; ///< casts shadows
  std::function<void(vtkPenumbraRayCaster*)> Choose;
};

const std::vector<Effect>& GetEffects()
{
  static const std::vector<Effect> effects = {
    { "none", false, [](vtkPenumbraRayCaster*) {} },
    { "occlusion", false,
      [](vtkPenumbraRayCaster* caster) {
        caster->AmbientOcclusionOn();
        caster->SetAmbientOcclusionStrength(1.0);
      } },
    { "indirect", true,
      [](vtkPenumbraRayCaster* caster) {
        caster->ShadowsOn();
        caster->IndirectLightOn();
        caster->SetEnvironmentColor(0.5, 0.6, 0.8);
      } },
    { "penumbrae", true,
      [](vtkPenumbraRayCaster* caster) {
        caster->ShadowsOn();
        caster->SetLightAngle(10.0);
      } },
    { "shafts", true,
      [](vtkPenumbraRayCaster* caster) {
        caster->ShadowsOn();
        caster->SetMedium(vtkNew<vtkPenumbraMedium>());
      } },
  };
  return effects;
}

/// Adds a directional light from above and beside the camera.
void AddLight(vtkRenderer* renderer)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  double view[3];
  double up[3];
  camera->GetDirectionOfProjection(view);
  camera->GetViewUp(up);
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetFocalPoint(0.0, 0.0, 0.0);
  light->SetPosition(0.7 * up[0] + 0.4 * (view[1] * up[2] - view[2] * up[1]) - 0.5 * view[0],
    0.7 * up[1] + 0.4 * (view[2] * up[0] - view[0] * up[2]) - 0.5 * view[1],
    0.7 * up[2] + 0.4 * (view[0] * up[1] - view[1] * up[0]) - 0.5 * view[2]);
  renderer->AddLight(light);
}

struct Accuracy
{
  double AboveTolerance = 0.0;  ///< fraction of tiles
  double Misjudged = 0.0;       ///< fraction of tiles above it with an estimate below their error
  double FalselyReported = 0.0; ///< fraction of tiles below it with an estimate above it
  double MedianRatio = 0.0;     ///< of estimate and error
  double Error = 0.0;           ///< RMSE of the image
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
    accuracy.FalselyReported += !above && tile.Estimate > tolerance ? 1.0 : 0.0;
    squares += tile.Error * tile.Error;
    if (tile.Error > 0.05 * tolerance)
    {
      ratios.push_back(tile.Estimate / tile.Error);
    }
  }
  const auto count = static_cast<double>(tiles.size());
  accuracy.AboveTolerance /= count;
  accuracy.Misjudged /= count;
  accuracy.FalselyReported /= count;
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
        caster->GetConstants().CoverageMethod = penumbra::CoverageMethods::Uniform;
        caster->GetConstants().UniformSamples = n;
        caster->SetShadows(scene.Shadows);
      });
    const Accuracy accuracy =
      Summarize(CompareTiles(answer, reference, AccuracyImageSide), 1.0 / 256.0);
    ladder.emplace_back(accuracy.Error, seconds ? answer.Seconds : answer.RaysPerPixel);
  }
  return CostAtError(ladder, error);
}

Accuracy Measure(const AccuracyScene& scene, const Effect& effect, const Options& options)
{
  vtkNew<vtkRenderer> renderer;
  scene.Build(renderer);
  constexpr int Side = AccuracyImageSide;
  const bool hasEffect = effect.Name != "none";
  double tolerance = 1.0 / options.InverseTolerance;
  if (effect.NeedsLight)
  {
    AddLight(renderer);
  }
  const auto choose = [&](vtkPenumbraRayCaster* caster) {
    caster->SetTolerance(1.0 / options.InverseTolerance);
    caster->SetShadows(scene.Shadows);
    effect.Choose(caster);
  };
  const Answer answer = Cast(renderer, Side, Side, [&](vtkPenumbraRayCaster* caster) {
    choose(caster);
    if (hasEffect)
    {
      tolerance = std::hypot(tolerance, caster->GetEffectiveLightTolerance());
    }
  });
  const StratifiedReference reference = hasEffect
    ? DrawWithLight(renderer, Side, Side, options.ReferenceSide, choose)
    : DrawStratified(renderer, Side, Side, options.ReferenceSide, scene.Shadows);
  const Accuracy accuracy = Summarize(CompareTiles(answer, reference, Side), tolerance);
  std::printf("| %-22s | %-9s | %5.1f | %5.1f | %5.1f | %5.2f | %.5f | %7.2f | %6.3f |",
    scene.Name.c_str(), effect.Name.c_str(), 100.0 * accuracy.AboveTolerance,
    100.0 * accuracy.Misjudged, 100.0 * accuracy.FalselyReported, accuracy.MedianRatio,
    accuracy.Error, answer.RaysPerPixel, answer.Seconds);
  if (options.Uniform)
  {
    std::printf(" %8.2f |", ComputeUniformCost(renderer, scene, reference, accuracy.Error, false));
  }
  std::printf("\n");
  std::fflush(stdout);
  return accuracy;
}

/// Returns the fastest of three casts.
Answer CastThrice(vtkRenderer* renderer, double tolerance)
{
  Answer best;
  for (int i = 0; i < 3; ++i)
  {
    Answer answer = Cast(renderer, OrdinaryImageWidth, OrdinaryImageHeight,
      [=](vtkPenumbraRayCaster* caster) { caster->SetTolerance(tolerance); });
    if (i == 0 || answer.Seconds < best.Seconds)
    {
      best = std::move(answer);
    }
  }
  return best;
}

/// Returns the CPU time in which OpenGL renders the second frame of a window with 4x4 samples per
/// pixel.
double RenderWithOpenGL(vtkRenderer* renderer)
{
  vtkNew<vtkRenderWindow> window;
  window->OffScreenRenderingOn();
  window->SetMultiSamples(0);
  window->SetSize(4 * OrdinaryImageWidth, 4 * OrdinaryImageHeight);
  window->AddRenderer(renderer);
  window->Render();
  renderer->GetActiveCamera()->Azimuth(0.01);
  const std::clock_t start = std::clock();
  window->Render();
  window->WaitForCompletion();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Time and accuracy of scenes as applications show them, beside the same without lines,
/// translucency and texture, and beside OpenGL.
void MeasureOrdinaryScenes(const Options& options)
{
  const double tolerance = 1.0 / options.InverseTolerance;
  std::printf("# Scenes as applications show them\n\n- %s\n- %s\n- the fastest of three images; "
              "plain: without lines, "
              "translucency and texture; VTK: the second frame of a window\n\n",
    RunLine().c_str(), VersionLine().c_str());
  std::printf(
    "Tolerance 1/%g, %dx%d pixels, one thread, tiles of 16x16 pixels, %d reference samples per "
    "pixel\n\n",
    options.InverseTolerance, OrdinaryImageWidth, OrdinaryImageHeight,
    2 * options.ReferenceSide * options.ReferenceSide);
  std::printf(
    "| scene | CPU s | / plain | VTK, 4x4 samples, CPU s | tiles above the tolerance, %% | "
    "of all tiles, above and estimate below error, %% | estimate above it, %% | median estimate "
    "/ error | RMSE |\n|---|---|---|---|---|---|---|---|---|\n");
  double seconds = 0.0;
  double slowest = 0.0;
  double secondsOfOpenGL = 0.0;
  double aboveTolerance = 0.0;
  int scenes = 0;
  for (const OrdinaryScene& scene : MakeOrdinaryScenes(PENUMBRA_SOURCE_DIR "/Data"))
  {
    if (scene.Name.find(options.Only) == std::string::npos)
    {
      continue;
    }
    vtkNew<vtkRenderer> plain;
    scene.Plain(plain);
    vtkNew<vtkRenderer> renderer;
    scene.Build(renderer);
    const double plainSeconds = CastThrice(plain, tolerance).Seconds;
    const Answer answer = CastThrice(renderer, tolerance);
    Accuracy accuracy;
    double reported = 0.0;
    if (options.ReferenceSide > 0)
    {
      const std::vector<TileAccuracy> tiles = CompareTiles(answer,
        DrawStratified(
          renderer, OrdinaryImageWidth, OrdinaryImageHeight, options.ReferenceSide, false),
        OrdinaryImageWidth);
      accuracy = Summarize(tiles, tolerance);
      reported = static_cast<double>(std::count_if(tiles.begin(), tiles.end(),
                   [=](const TileAccuracy& tile) { return tile.Estimate > tolerance; })) /
        static_cast<double>(tiles.size());
    }
    const double ofOpenGL = RenderWithOpenGL(renderer);
    std::printf("| %-44s | %6.3f | %5.1f | %6.3f | %5.2f | %5.2f | %5.2f | %5.2f | %.5f |\n",
      scene.Name.c_str(), answer.Seconds, answer.Seconds / plainSeconds, ofOpenGL,
      100.0 * accuracy.AboveTolerance, 100.0 * accuracy.Misjudged, 100.0 * reported,
      accuracy.MedianRatio, accuracy.Error);
    std::fflush(stdout);
    seconds += answer.Seconds;
    slowest = std::max(slowest, answer.Seconds);
    secondsOfOpenGL += ofOpenGL;
    aboveTolerance += accuracy.AboveTolerance;
    ++scenes;
  }
  const auto judge = [](const char* quantity, double measured, double target) {
    std::printf("| %s | %.3g | <= %g | %s |\n", quantity, measured, target,
      measured <= target ? "met" : "**missed**");
  };
  std::printf("\n| all %d scenes | measured | target | |\n|---|---|---|---|\n", scenes);
  judge("CPU seconds / those of VTK", seconds / secondsOfOpenGL, 1.0);
  judge("CPU seconds of the slowest", slowest, 1.0);
  if (options.ReferenceSide > 0)
  {
    judge("tiles above the tolerance, %", 100.0 * aboveTolerance / scenes, 1.0);
  }
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
    options.Ordinary = options.Ordinary || name == "--ordinary";
    options.Only = name == "--only" ? value : options.Only;
    options.InverseTolerance =
      name == "--inverse-tolerance" ? std::atof(value) : options.InverseTolerance;
    options.ReferenceSide = name == "--reference" ? std::atoi(value) : options.ReferenceSide;
    options.Effect = name == "--effect" ? value : options.Effect;
  }
  const auto isSelected = [&](const Effect& effect) {
    return options.Effect == "all" || options.Effect == effect.Name;
  };
  if (options.Ordinary)
  {
    MeasureOrdinaryScenes(options);
    return 0;
  }
  if (std::none_of(GetEffects().begin(), GetEffects().end(), isSelected))
  {
    std::fprintf(stderr, "--effect: use none, occlusion, indirect, penumbrae, shafts or all\n");
    return 2;
  }
  std::printf("# Accuracy of images in scenes that no constant was chosen with\n\n- %s\n- %s\n"
              "- the error of the reference is subtracted, but its noise remains: it causes the "
              "small ratios of scenes that are "
              "covered exactly\n\n",
    RunLine().c_str(), VersionLine().c_str());
  std::printf("Tolerance 1/%g, one thread, %dx%d pixels, tiles of 16x16 pixels, %d reference "
              "samples per pixel\n\n",
    options.InverseTolerance, AccuracyImageSide, AccuracyImageSide,
    2 * options.ReferenceSide * options.ReferenceSide);
  std::printf("| scene | effect | tiles above the tolerance, %% | of all tiles, above and estimate "
              "below error, %% | below, but reported, %% | median estimate / error | RMSE | rays "
              "per pixel | CPU s |%s\n",
    options.Uniform ? " rays of uniform samples with this error |" : "");
  std::printf("|---|---|---|---|---|---|---|---|---|%s\n", options.Uniform ? "---|" : "");
  for (const Effect& effect : GetEffects())
  {
    Accuracy sum;
    int scenes = 0;
    for (const AccuracyScene& scene : GetAccuracyScenes())
    {
      if (isSelected(effect) && scene.Name.find(options.Only) != std::string::npos)
      {
        const Accuracy accuracy = Measure(scene, effect, options);
        sum.AboveTolerance += 100.0 * accuracy.AboveTolerance;
        sum.Misjudged += 100.0 * accuracy.Misjudged;
        sum.FalselyReported += 100.0 * accuracy.FalselyReported;
        ++scenes;
      }
    }
    if (scenes > 0)
    {
      std::printf("| **%d scenes** | %-9s | %5.1f | %5.1f | %5.1f | | | | |\n", scenes,
        effect.Name.c_str(), sum.AboveTolerance / scenes, sum.Misjudged / scenes,
        sum.FalselyReported / scenes);
    }
  }
  return 0;
}
