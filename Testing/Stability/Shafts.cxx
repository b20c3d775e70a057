// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Light shafts where the paper names its limits: lights beside and behind the view, occluders at the
// border, things in front. Against the ray caster's marched reference, in units of a white surface.
#include "Scenario.h"
#include "ShaftScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkProperty.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

namespace
{

using Pass = vtkPenumbraLightShaftPass;

constexpr double WholeSphere = 12.566370614359172;
constexpr double EdgeDensity = .12;
const Vector SunInView = { .2, 1.0, .32 };

struct Haze : ShaftScene
{
  explicit Haze(int solids = 10)
    : ShaftScene(96, 72)
  {
    this->AddFloor(12.0);
    this->AddSolids(solids, 2);
    this->Look({ .5, -11.0, 2.5 }, { 0.0, 0.0, 2.0 });
    this->SetMedium(EdgeDensity, EdgeDensity);
  }
};

/// Of what a ray that is lit from end to end would scatter: the brightest becomes white.
Frame Amplified(const ShaftScene& scene, const std::vector<double>& values)
{
  Frame picture{ scene.Width, scene.Height, values };
  for (double& value : picture.Values)
  {
    value *= WholeSphere;
  }
  return picture;
}

double RelativeRmse(const std::vector<double>& values, const std::vector<double>& truth)
{
  return Rmse(values, truth) / Rmse(truth, std::vector<double>(truth.size(), 0.0));
}

ScenarioResult Judge(ShaftScene& scene)
{
  const std::vector<double> light = scene.RenderWithPass();
  return { RelativeRmse(light, scene.RenderWithRayCaster(64)), Amplified(scene, light) };
}

/// Under a sun; broken: the paper's mean of a mask.
std::function<ScenarioResult(Variant)> UnderASun(const Vector& towards)
{
  return [towards](Variant variant) {
    Haze scene;
    scene.AddSun(towards);
    scene.Pass->SetEstimator(variant == Variant::Ablated ? Pass::RADIAL : Pass::DEPTH);
    return Judge(scene);
  };
}

ScenarioResult UnderALamp(Variant variant)
{
  Haze scene;
  scene.AddLamp({ 1.0, 2.0, 3.0 });
  scene.Pass->SetEstimator(variant == Variant::Ablated ? Pass::RADIAL : Pass::DEPTH);
  return Judge(scene);
}

ScenarioResult InParallel(Variant variant)
{
  Haze scene;
  scene.AddSun({ 1.0, .6, .9 });
  scene.Look({ .5, -9.0, 8.0 }, { 0.0, 0.0, 1.0 });
  scene.Renderer->GetActiveCamera()->ParallelProjectionOn();
  scene.Renderer->GetActiveCamera()->SetParallelScale(3.5);
  scene.Pass->SetEstimator(variant == Variant::Ablated ? Pass::RADIAL : Pass::DEPTH);
  return Judge(scene);
}

/// Thin plates: what they hide ends soon behind them.
ScenarioResult ThinOccluders(Variant variant)
{
  Haze scene(0);
  for (int i = 0; i < 5; ++i)
  {
    scene.AddBox({ 1.6 * i - 3.2, .4 * i, 2.0 }, { .7, .1, 2.4 });
  }
  scene.AddSun(SunInView);
  scene.Pass->SetThickness(variant == Variant::Ablated ? 1e6 : 0.0);
  return Judge(scene);
}

/// A small box close to the eye: the light behind it adds nothing.
ScenarioResult BehindAForeground(Variant variant)
{
  Haze scene;
  scene.AddBox({ 1.5, -8.0, 2.5 }, { .6, .1, .6 });
  scene.AddSun(SunInView);
  scene.Pass->SetEstimator(variant == Variant::Ablated ? Pass::RADIAL : Pass::DEPTH);
  const std::vector<double> light = scene.RenderWithPass();
  const std::vector<double> truth = scene.RenderWithRayCaster(64);
  double most = 0.0;
  for (int i = 0; i < 25; ++i)
  {
    const int pixel = (35 + i / 5) * scene.Width + 79 + i % 5;
    most = std::max(most, std::abs(light[pixel] - truth[pixel]) * WholeSphere);
  }
  return { most, Amplified(scene, light) };
}

/// The light turns by a degree a frame, from beside the picture to the back.
ScenarioResult SweepingLight(Variant variant)
{
  Haze scene;
  const auto sun = scene.AddSun(SunInView);
  scene.Pass->SetEstimator(variant == Variant::Ablated ? Pass::RADIAL : Pass::DEPTH);
  std::vector<std::vector<double>> times;
  for (int angle = 60; angle < 120; angle += 2)
  {
    const double a = angle * 0.017453292519943295;
    sun->SetPosition(std::sin(a), std::cos(a), .2);
    times.push_back(scene.RenderWithPass());
    for (double& value : times.back())
    {
      value *= WholeSphere;
    }
  }
  return { Pop(times), Amplified(scene, scene.RenderWithPass()) };
}

/// An occluder leaves the picture towards the light, a pixel a frame.
ScenarioResult OccluderCrossesTheBorder(Variant variant)
{
  Haze scene(0);
  const auto ball = scene.AddSphere({ 0.0, 0.0, 2.0 }, .8);
  scene.AddSun({ .6, 1.0, .2 });
  scene.Pass->SetMargin(variant == Variant::Ablated ? 0.0 : -1.0);
  double worst = 0.0;
  Frame picture;
  for (int frame = 0; frame < 12; ++frame)
  {
    ball->SetPosition(4.6 + .12 * frame, 0.0, 0.0);
    const std::vector<double> light = scene.RenderWithPass();
    worst = std::max(worst, RelativeRmse(light, scene.RenderWithRayCaster(32)));
    picture = Amplified(scene, light);
  }
  return { worst, picture };
}

/// An occluder that stands outside of the picture on the way to the light.
ScenarioResult OccluderOutside(Variant variant)
{
  Haze scene(0);
  scene.AddSphere({ 5.6, 0.0, 2.0 }, .9);
  scene.AddSun({ .6, 1.0, .2 });
  scene.Pass->SetMargin(variant == Variant::Ablated ? 0.0 : -1.0);
  return Judge(scene);
}

/// The paper's estimator: its brightness must not depend on the number of samples.
ScenarioResult NumberOfSamples(Variant variant)
{
  std::vector<std::vector<double>> pictures;
  Frame picture;
  for (const int steps : { 16, 64, 256 })
  {
    Haze scene;
    scene.AddSun(SunInView);
    scene.Pass->SetEstimator(Pass::RADIAL);
    scene.Pass->SetDecay(.98);
    scene.Pass->SetSteps(steps);
    // The listing leaves out the division by the number of samples.
    scene.Pass->SetWeight(variant == Variant::Ablated ? steps / 64.0 : 1.0);
    pictures.push_back(scene.RenderWithPass());
    picture = Amplified(scene, pictures.back());
  }
  return { EnergyChange(pictures), picture };
}

/// A scene in another unit of length; broken: a medium that keeps its numbers.
ScenarioResult Units(Variant variant)
{
  std::vector<std::vector<double>> pictures;
  Frame picture;
  for (const double unit : { 1.0, 1e-3 })
  {
    ShaftScene scene(96, 72);
    scene.AddBox({ 0.0, 0.0, unit }, { unit, unit, 2.0 * unit });
    scene.AddSphere({ 2.0 * unit, unit, 2.0 * unit }, .6 * unit);
    scene.AddFloor(6.0 * unit);
    scene.AddSun(SunInView);
    scene.Look({ .5 * unit, -11.0 * unit, 2.5 * unit }, { 0.0, 0.0, 2.0 * unit });
    if (variant == Variant::Ablated)
    {
      scene.SetMedium(EdgeDensity, EdgeDensity);
    }
    pictures.push_back(scene.RenderWithPass());
    picture = Amplified(scene, pictures.back());
  }
  return { RelativeRmse(pictures[1], pictures[0]), picture };
}

/// A still scene is computed once; broken: the light trembles by what nobody sees.
ScenarioResult StillScene(Variant variant)
{
  Haze scene;
  const auto sun = scene.AddSun(SunInView);
  std::vector<std::vector<double>> times;
  for (int frame = 0; frame < 3; ++frame)
  {
    times.push_back(scene.RenderWithPass());
    if (variant == Variant::Ablated)
    {
      sun->SetPosition(SunInView[0] + 1e-3 * frame, SunInView[1], SunInView[2]);
    }
  }
  return { Flicker(times), Amplified(scene, times.back()) };
}

/// Lit shares for 2x2 pixels, at the edges of what stands in front.
ScenarioResult HalfResolution(Variant variant)
{
  Haze scene;
  scene.AddSun(SunInView);
  scene.Pass->SetTolerance(1.0 / 64.0);
  scene.Pass->SetSteps(variant == Variant::Ablated ? 2 : 0);
  return Judge(scene);
}

/// Two chained passes of 8 samples against a loop of 64; broken: a loop of even steps.
ScenarioResult Chained(Variant variant)
{
  Haze scene;
  scene.AddSun(SunInView);
  scene.Pass->SetEstimator(Pass::RADIAL);
  scene.Pass->SetTolerance(1.0 / 1024.0); // a share for every pixel
  scene.Pass->SetSpacing(variant == Variant::Ablated ? Pass::EVEN : Pass::GEOMETRIC);
  scene.Pass->SetSteps(64);
  const std::vector<double> loop = scene.RenderWithPass();
  scene.Pass->SetSteps(8);
  scene.Pass->SetPasses(2);
  const std::vector<double> chained = scene.RenderWithPass();
  const Frame picture = Amplified(scene, chained);
  return { LargestDifference(picture.Values, Amplified(scene, loop).Values), picture };
}

/// A sun and a lamp; broken: the first light alone.
ScenarioResult TwoLights(Variant variant)
{
  Haze scene;
  const vtkSmartPointer<vtkLight> sun = scene.AddSun(SunInView);
  scene.AddLamp({ 1.0, 2.0, 3.0 });
  if (variant == Variant::Ablated)
  {
    scene.Pass->AddLight(sun);
  }
  return Judge(scene);
}

/// A pane of glass between the eye and the haze does not stop the light behind it; broken: the pass takes
/// it for the end of the way.
ScenarioResult BehindGlass(Variant variant)
{
  const auto draw = [variant](bool hasPane) {
    Haze scene;
    scene.AddSun(SunInView);
    if (hasPane)
    {
      const auto pane = scene.AddBox({ .5, -9.0, 2.5 }, { 1.2, .01, 1.2 });
      pane->GetProperty()->SetOpacity(variant == Variant::Ablated ? 1.0 : .4);
    }
    return Amplified(scene, scene.RenderWithPass());
  };
  const Frame behind = draw(true);
  return { LargestDifference(behind.Values, draw(false).Values), behind };
}

/// The right half of a window, and the same picture alone, an occluder outside of both.
ScenarioResult InAViewport(Variant variant)
{
  const auto draw = [variant](bool isHalf) {
    ShaftScene scene(isHalf ? 192 : 96, 72);
    scene.AddFloor(12.0);
    scene.AddSphere({ 5.6, 0.0, 2.0 }, .9);
    scene.Look({ .5, -11.0, 2.5 }, { 0.0, 0.0, 2.0 });
    scene.SetMedium(EdgeDensity, EdgeDensity);
    scene.AddSun({ .6, 1.0, .2 });
    if (isHalf)
    {
      scene.Renderer->SetViewport(.5, 0.0, 1.0, 1.0);
      scene.Pass->SetMargin(variant == Variant::Ablated ? 0.0 : -1.0);
    }
    return Frame{ 96, 72, scene.RenderWithPass() };
  };
  Frame half = draw(true);
  Frame alone = draw(false);
  for (Frame* each : { &half, &alone })
  {
    for (double& value : each->Values)
    {
      value *= WholeSphere;
    }
  }
  return { LargestDifference(half.Values, alone.Values), half };
}

}

std::vector<Scenario> ShaftScenarios()
{
  const std::string scene = "solids over a floor in haze";
  const std::string mask = "depth along the way to the light: the mean of a mask [Shafts eq. 3]";
  const std::string margin = "a margin around the picture: none";
  return {
    { "ShaftsSunInView", scene + ", the sun in view", "still", Metric::Bias, .03, mask,
      "[Shafts] no depth along the way", "", UnderASun(SunInView) },
    { "ShaftsSunOutside", scene + ", the sun outside of the picture", "still", Metric::Bias, .03,
      mask, "[Shafts] no depth along the way", "", UnderASun({ .72, 1.0, .32 }) },
    { "ShaftsSunAtRightAngles", scene + ", the sun at right angles to the view", "still",
      Metric::Bias, .03, mask, "[Shafts] a light at right angles to the view", "",
      UnderASun({ 1.0, .0455, .32 }) },
    { "ShaftsSunBehind", scene + ", the sun behind the eye", "still", Metric::Bias, .012, mask,
      "[Shafts] a light behind the view", "", UnderASun({ .3, -1.0, .5 }) },
    { "ShaftsLamp", scene + ", a lamp among them", "still", Metric::Bias, .04, mask,
      "[Shafts] directional lights only", "", UnderALamp },
    { "ShaftsInParallel", scene + ", in parallel projection", "still", Metric::Bias, .03, mask, "",
      "", InParallel },
    { "ShaftsThinOccluders", "five plates in haze", "still", Metric::Bias, .05,
      "thickness of what is seen: endless", "[Shafts] one layer of depth", "", ThinOccluders },
    { "ShaftsBehindAForeground", scene + ", a box close to the eye", "still",
      Metric::MaximumDifference, .02, mask, "[Shafts] shafts drawn over the foreground", "",
      BehindAForeground },
    { "ShaftsSweepingLight", scene, "the light turns past the eye, 2 degrees a frame", Metric::Pop,
      .09, mask, "[Shafts] a light at right angles to the view", "", SweepingLight },
    { "ShaftsOccluderCrossesTheBorder", "a ball in haze", "it leaves the picture", Metric::Bias,
      .04, margin, "[Shafts] flicker at the image border", "", OccluderCrossesTheBorder },
    { "ShaftsOccluderOutside", "a ball outside of the picture", "still", Metric::Bias, .03, margin,
      "[Shafts] flicker at the image border", "", OccluderOutside },
    { "ShaftsNumberOfSamples", scene + ", by [Shafts eq. 4] with 16, 64, 256 samples", "still",
      Metric::Energy, .1, "division by the number of samples: as in the listing",
      "[Shafts] the listing omits 1/n", "", NumberOfSamples },
    { "ShaftsUnit", "solids in haze, 1e-3 times as large", "still", Metric::UnitIndependence, .01,
      "a medium from the bounds: .12 a unit", "", "", Units },
    { "ShaftsStillScene", scene, "still", Metric::Flicker, 0.0,
      "stillness: the sun trembles by 1/1000", "[Shafts] flickers in a still scene", "",
      StillScene },
    { "ShaftsHalfResolution", scene + ", tolerance 1/64", "still", Metric::Bias, .025,
      "steps from the tolerance: 2", "", "", HalfResolution },
    { "ShaftsChained", scene + ", two passes of 8 samples against a loop of 64", "still",
      Metric::MaximumDifference, .02, "geometric distances of samples: even ones",
      "[Shafts 13.8] chained passes are no long loop", "", Chained },
    { "ShaftsTwoLights", scene + ", a sun and a lamp", "still", Metric::Bias, .04,
      "a pass for each light: one", "[Shafts 13.3.1] one light", "", TwoLights },
    { "ShaftsBehindGlass", scene + ", a pane of glass before the eye", "still",
      Metric::MaximumDifference, .001, "what is translucent is looked through: it is opaque",
      "[Shafts] translucent props", "", BehindGlass },
    { "ShaftsInAViewport", "half of a window, a ball outside of it", "still",
      Metric::MaximumDifference, .01, "a margin around the viewport: none",
      "[Shafts] several viewports", "", InAViewport },
  };
}

}
