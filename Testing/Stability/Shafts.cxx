// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Light shafts in the cases that the paper names as limits: lights beside and behind the camera,
// occluders at the edge of the image, objects in front. Images are compared with the ray-marched
// reference of the ray caster.
#include "Scenario.h"
#include "ShaftScene.h"
#include "vtkPenumbraShaftConstants.h"

#include "Frame/ScopedShaderEdit.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkProperty.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace penumbra
{

namespace
{

using Pass = vtkPenumbraLightShaftPass;

constexpr double WholeSphere = 4.0 * glm::pi<double>();
constexpr double EdgeDensity = .12;
const Vector SunInView = { .2, 1.0, .32 };

/// Ablated: with a part of the shaders replaced.
struct ShaderAblation
{
  ShaderAblation(Variant variant, const char* part, const char* replacement)
  {
    if (variant == Variant::Ablated)
    {
      this->Edit.emplace(part, replacement);
    }
  }

  std::optional<ScopedShaderEdit> Edit;
};

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

/// Scales in-scattered light by 4 pi, so that a fully lit, infinitely long ray with isotropic
/// scattering becomes white.
Frame Amplified(const ShaftScene& scene, const std::vector<double>& values)
{
  Frame image{ scene.Width, scene.Height, values };
  for (double& value : image.Values)
  {
    value *= WholeSphere;
  }
  return image;
}

double RelativeRmse(const std::vector<double>& values, const std::vector<double>& reference)
{
  return Rmse(values, reference) / Rmse(reference, std::vector<double>(reference.size(), 0.0));
}

ScenarioResult CompareWithRayCaster(ShaftScene& scene)
{
  const std::vector<double> light = scene.RenderWithPass();
  return { RelativeRmse(light, scene.RenderWithRayCaster(64)), Amplified(scene, light) };
}

/// A directional light. Ablated: with a part of the shaders replaced.
std::function<ScenarioResult(Variant)> DirectionalLight(
  const Vector& direction, const char* part, const char* replacement)
{
  return [direction, part, replacement](Variant variant) {
    Haze scene;
    scene.AddSun(direction);
    const ShaderAblation ablation(variant, part, replacement);
    return CompareWithRayCaster(scene);
  };
}

ScenarioResult PositionalLight(Variant variant)
{
  Haze scene;
  scene.AddLamp({ 1.0, 2.0, 3.0 });
  const ShaderAblation ablation(variant, "1.0 / span - q * light.w", "1.0 / span");
  return CompareWithRayCaster(scene);
}

/// Ablated: the depth along a path to the light is computed as in perspective.
ScenarioResult InParallel(Variant variant)
{
  Haze scene;
  scene.AddSun({ .3, 1.0, .3 });
  scene.Look({ .5, -9.0, 8.0 }, { 0.0, 0.0, 1.0 });
  scene.Renderer->GetActiveCamera()->ParallelProjectionOn();
  scene.Renderer->GetActiveCamera()->SetParallelScale(3.5);
  const ShaderAblation ablation(
    variant, "if (perspective < 0.5)\n  {\n    return (span", "if (false)\n  {\n    return (span");
  return CompareWithRayCaster(scene);
}

/// Thin plates, whose shadows are bounded by the thickness of visible surfaces.
ScenarioResult ThinOccluders(Variant variant)
{
  Haze scene(0);
  for (int i = 0; i < 5; ++i)
  {
    scene.AddBox({ 1.6 * i - 3.2, .4 * i, 2.0 }, { .7, .1, 2.4 });
  }
  scene.AddSun(SunInView);
  scene.Pass->SetThickness(variant == Variant::Ablated ? 1e6 : 0.0);
  return CompareWithRayCaster(scene);
}

/// A small box close to the camera: light behind it adds nothing.
ScenarioResult BehindAForeground(Variant variant)
{
  Haze scene;
  scene.AddBox({ 1.5, -8.0, 2.5 }, { .6, .1, .6 });
  scene.AddSun(SunInView);
  const ShaderAblation ablation(variant, "ViewRay ray = makeViewRay(pixel, eyeDepth);",
    "ViewRay ray = makeViewRay(pixel, farAway);");
  const std::vector<double> light = scene.RenderWithPass();
  const std::vector<double> reference = scene.RenderWithRayCaster(64);
  double maximum = 0.0;
  for (int i = 0; i < 25; ++i)
  {
    const int pixel = (35 + i / 5) * scene.Width + 79 + i % 5;
    maximum = std::max(maximum, std::abs(light[pixel] - reference[pixel]) * WholeSphere);
  }
  return { maximum, Amplified(scene, light) };
}

/// The light rotates by 2 degrees per frame, from beside the view to behind the camera. Ablated:
/// consecutive steps are connected even if they are on different surfaces.
ScenarioResult SweepingLight(Variant variant)
{
  Haze scene;
  const auto sun = scene.AddSun(SunInView);
  const ShaderAblation ablation(variant, "if (!sameSurface)", "if (false)");
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

/// An occluder leaves the image toward the light, by about a pixel per frame.
ScenarioResult OccluderCrossesImageEdge(Variant variant)
{
  Haze scene(0);
  const auto ball = scene.AddSphere({ 0.0, 0.0, 2.0 }, .8);
  scene.AddSun({ .6, 1.0, .2 });
  scene.Pass->GetConstants().Margin = variant == Variant::Ablated ? 0.0 : -1.0;
  double worst = 0.0;
  Frame image;
  for (int frame = 0; frame < 12; ++frame)
  {
    ball->SetPosition(4.6 + .12 * frame, 0.0, 0.0);
    const std::vector<double> light = scene.RenderWithPass();
    worst = std::max(worst, RelativeRmse(light, scene.RenderWithRayCaster(32)));
    image = Amplified(scene, light);
  }
  return { worst, image };
}

/// An occluder outside of the image, between visible air and the light.
ScenarioResult OccluderOutside(Variant variant)
{
  Haze scene(0);
  scene.AddSphere({ 5.6, 0.0, 2.0 }, .9);
  scene.AddSun({ .6, 1.0, .2 });
  scene.Pass->GetConstants().Margin = variant == Variant::Ablated ? 0.0 : -1.0;
  return CompareWithRayCaster(scene);
}

/// The estimator of the paper: its brightness must not depend on the number of samples.
ScenarioResult NumberOfSamples(Variant variant)
{
  std::vector<std::vector<double>> images;
  Frame image;
  for (const int steps : { 16, 64, 256 })
  {
    Haze scene;
    scene.AddSun(SunInView);
    scene.Pass->SetEstimator(Pass::RADIAL);
    scene.Pass->GetConstants().Decay = .98;
    scene.Pass->GetConstants().Steps = steps;
    // The listing omits the division by the number of samples.
    scene.Pass->GetConstants().Weight = variant == Variant::Ablated ? steps / 64.0 : 1.0;
    images.push_back(scene.RenderWithPass());
    image = Amplified(scene, images.back());
  }
  return { EnergyChange(images), image };
}

/// A scene in another unit of length. Ablated: a medium with fixed coefficients.
ScenarioResult Units(Variant variant)
{
  std::vector<std::vector<double>> images;
  Frame image;
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
    images.push_back(scene.RenderWithPass());
    image = Amplified(scene, images.back());
  }
  return { RelativeRmse(images[1], images[0]), image };
}

/// A static scene is computed once. Ablated: the light moves by an invisible amount.
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

/// Lit fractions of blocks of 2x2 pixels, at silhouettes.
ScenarioResult HalfResolution(Variant variant)
{
  Haze scene;
  scene.AddSun(SunInView);
  scene.Pass->SetTolerance(1.0 / 64.0);
  scene.Pass->GetConstants().Steps = variant == Variant::Ablated ? 2 : 0;
  return CompareWithRayCaster(scene);
}

/// Two chained passes of 8 samples against one loop of 64. Ablated: uniform sample distances.
ScenarioResult Chained(Variant variant)
{
  Haze scene;
  scene.AddSun(SunInView);
  scene.Pass->SetEstimator(Pass::RADIAL);
  scene.Pass->SetTolerance(1.0 / 1024.0); // a lit fraction for every pixel
  scene.Pass->GetConstants().Spacing = variant == Variant::Ablated
    ? penumbra::ShaftSpacings::Even
    : penumbra::ShaftSpacings::Geometric;
  scene.Pass->GetConstants().Steps = 64;
  const std::vector<double> loop = scene.RenderWithPass();
  scene.Pass->GetConstants().Steps = 8;
  scene.Pass->GetConstants().Passes = 2;
  const std::vector<double> chained = scene.RenderWithPass();
  const Frame image = Amplified(scene, chained);
  return { LargestDifference(image.Values, Amplified(scene, loop).Values), image };
}

/// A directional and a positional light. Ablated: the directional light only.
ScenarioResult TwoLights(Variant variant)
{
  Haze scene;
  const vtkSmartPointer<vtkLight> sun = scene.AddSun(SunInView);
  scene.AddLamp({ 1.0, 2.0, 3.0 });
  if (variant == Variant::Ablated)
  {
    scene.Pass->AddLight(sun);
  }
  return CompareWithRayCaster(scene);
}

/// A pane of glass in front of the haze does not block the light behind it. Ablated: the pane is
/// opaque.
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

/// The right half of a window, and the same image in a window of its size, with an occluder outside
/// of both.
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
      scene.Pass->GetConstants().Margin = variant == Variant::Ablated ? 0.0 : -1.0;
    }
    return Frame{ 96, 72, scene.RenderWithPass() };
  };
  Frame half = draw(true);
  Frame separate = draw(false);
  for (Frame* each : { &half, &separate })
  {
    for (double& value : each->Values)
    {
      value *= WholeSphere;
    }
  }
  return { LargestDifference(half.Values, separate.Values), half };
}

}

std::vector<Scenario> ShaftScenarios()
{
  const std::string scene = "solids over a floor in haze";
  const std::string margin = "margin around the image: none";
  return {
    { "ShaftsSunInView", scene + ", the light in view", "still", Metric::Bias, .03,
      "first shadowed depth along the ray: 0", "[Shafts] no depth along the ray", "",
      DirectionalLight(SunInView, "max(low, 0.0) * ray.lengthPerDepth", "0.0") },
    { "ShaftsSunOutside", scene + ", the light outside of the image", "still", Metric::Bias, .03,
      "last shadowed depth along the ray: the visible surface", "[Shafts] no depth along the ray",
      "", DirectionalLight({ .72, 1.0, .32 }, "max(min(high, eyeDepth), 0.0)", "eyeDepth") },
    { "ShaftsSunAtRightAngles", scene + ", the light at right angles to the view", "still",
      Metric::Bias, .012, "march ends at the image edge: at the light only",
      "[Shafts] a light at right angles to the view", "",
      DirectionalLight({ 1.0, .0455, .32 }, "min(min(edge.x, edge.y), end)", "end") },
    { "ShaftsSunBehind", scene + ", the light behind the camera", "still", Metric::Bias, .012,
      "depth changes along the path to the light: constant", "[Shafts] a light behind the view", "",
      DirectionalLight({ -.6, -1.0, .5 }, "max(1.0 - q * light.z, 0.0)", "1.0") },
    { "ShaftsLamp", scene + ", a positional light among them", "still", Metric::Bias, .04,
      "distance of the positional light: infinite", "[Shafts] directional lights only", "",
      PositionalLight },
    { "ShaftsInParallel", scene + ", in parallel projection", "still", Metric::Bias, .017,
      "depth along the path to the light in parallel projection: as in perspective", "", "",
      InParallel },
    { "ShaftsThinOccluders", "five plates in haze", "still", Metric::Bias, .05,
      "thickness of visible surfaces: unlimited", "[Shafts] one layer of depth", "",
      ThinOccluders },
    { "ShaftsBehindAForeground", scene + ", a box close to the camera", "still",
      Metric::MaximumDifference, .02, "in-scattering ends at the visible surface: does not end",
      "[Shafts] shafts drawn over the foreground", "", BehindAForeground },
    { "ShaftsSweepingLight", scene, "the light rotates past the camera, 2 degrees per frame",
      Metric::Pop, .09, "only steps on one surface are connected: all steps",
      "[Shafts] a light at right angles to the view", "", SweepingLight },
    { "ShaftsOccluderCrossesTheBorder", "a ball in haze", "it leaves the image", Metric::Bias, .04,
      margin, "[Shafts] flicker at the image edge", "", OccluderCrossesImageEdge },
    { "ShaftsOccluderOutside", "a ball outside of the image", "still", Metric::Bias, .03, margin,
      "[Shafts] flicker at the image edge", "", OccluderOutside },
    { "ShaftsNumberOfSamples", scene + ", by [Shafts eq. 4] with 16, 64 and 256 samples", "still",
      Metric::Energy, .1, "division by the number of samples: as in the listing",
      "[Shafts] the listing omits 1/n", "", NumberOfSamples },
    { "ShaftsUnit", "solids in haze, scaled by 1e-3", "still", Metric::UnitIndependence, .01,
      "medium scaled with the bounds: 0.12 per unit", "", "", Units },
    { "ShaftsStillScene", scene, "still", Metric::Flicker, 0.0,
      "reuse in a static scene: the light moves by 0.001", "[Shafts] flickers in a still scene", "",
      StillScene },
    { "ShaftsHalfResolution", scene + ", tolerance 1/64", "still", Metric::Bias, .025,
      "number of steps from the tolerance: 2 steps", "", "", HalfResolution },
    { "ShaftsChained", scene + ", two passes of 8 samples against a loop of 64", "still",
      Metric::MaximumDifference, .02, "geometric sample distances: uniform",
      "[Shafts 13.8] chained passes differ from one long loop", "", Chained },
    { "ShaftsTwoLights", scene + ", a directional and a positional light", "still", Metric::Bias,
      .04, "one pass per light: one pass", "[Shafts 13.3.1] one light", "", TwoLights },
    { "ShaftsBehindGlass", scene + ", a pane of glass in front of the camera", "still",
      Metric::MaximumDifference, .001, "translucent props do not block shafts: the pane is opaque",
      "[Shafts] translucent props", "", BehindGlass },
    { "ShaftsInAViewport", "a viewport of half a window, a ball outside of it", "still",
      Metric::MaximumDifference, .01, "margin around the viewport: none",
      "[Shafts] several viewports", "", InAViewport },
  };
}

}
