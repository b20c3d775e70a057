// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Light shafts in motion: only the added light, in 1/255 of the brightness of a white surface.
#include "Benchmark.h"
#include "ShaftScene.h"

#include "vtkActor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace penumbra
{

namespace
{

constexpr double EdgeDensity = 0.12;

double LargestChange(const std::vector<double>& a, const std::vector<double>& b)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const double change = std::abs(a[i] - b[i]);
    largest = change <= largest ? largest : std::isfinite(change) ? change : 1e30;
  }
  return largest;
}

/// The light moves one degree per frame from inside the image, past the camera plane, to the back.
void SweepLight(ShaftBenchmark& benchmark)
{
  ShaftScene scene(160, 120);
  scene.AddFloor(12.0);
  scene.AddSolids(14, 1);
  scene.Look({ 0.5, -11.0, 2.5 }, { 0.0, 0.0, 2.0 });
  scene.SetMedium(EdgeDensity, EdgeDensity);
  vtkSmartPointer<vtkLight> sun = scene.AddSun({ 0.0, 1.0, 0.2 });
  std::vector<double> before;
  std::vector<double> truthBefore;
  std::vector<std::vector<double>> strip;
  double largest = 0.0;
  double largestOfTruth = 0.0;
  int worst = 0;
  // The image ends 26 degrees from its center.
  for (int angle = 36; angle <= 180; ++angle)
  {
    const double a = angle * 0.017453292519943295;
    sun->SetPosition(std::sin(a), std::cos(a), 0.2);
    const std::vector<double> now = scene.RenderWithPass();
    if (!before.empty())
    {
      const double change = 255.0 * LargestChange(before, now);
      worst = change > largest ? angle : worst;
      largest = std::max(largest, change);
    }
    before = now;
    if (angle % 24 == 12)
    {
      strip.push_back(now);
    }
    if (angle >= 160 && angle <= 168) // range with the largest changes of the reference
    {
      const std::vector<double> truth = scene.RenderWithRayCaster(64);
      largestOfTruth = truthBefore.empty()
        ? 0.0
        : std::max(largestOfTruth, 255.0 * LargestChange(truthBefore, truth));
      truthBefore = truth;
    }
  }
  if (benchmark.Diagnose)
  {
    WriteImage(benchmark.Output + "/sweep.png", strip, scene.Width);
  }
  benchmark.Results.Add("light from 10 degrees outside to 180, 1 degree a frame",
    "largest change of a pixel, 1/255", largest, TargetKind::AtMost, 3.0,
    "at " + std::to_string(worst) + " degrees");
  benchmark.Results.Add("light from 160 to 168 degrees, 1 degree a frame",
    "largest change of a pixel of the reference, 1/255", largestOfTruth, TargetKind::None);
}

/// A sphere leaves the image at one pixel per frame; the directional light is outside the image.
void CrossBorder(ShaftBenchmark& benchmark)
{
  for (const double margin : { -1.0, 0.0 })
  {
    ShaftScene scene(160, 120);
    scene.AddFloor(12.0);
    const vtkSmartPointer<vtkActor> ball = scene.AddSphere({ 0.0, 0.0, 2.0 }, 0.8);
    scene.Look({ 0.5, -11.0, 2.5 }, { 0.0, 0.0, 2.0 });
    scene.AddSun({ 0.6, 1.0, 0.2 });
    scene.SetMedium(EdgeDensity, EdgeDensity);
    scene.Pass->SetMargin(margin);
    std::vector<double> before;
    std::vector<double> truthBefore;
    double largest = 0.0;
    for (int frame = 0; frame < 40; ++frame)
    {
      // A pixel is 11 * 0.728 / 120 world units at the distance of the sphere.
      ball->SetPosition(4.2 + 0.0667 * frame, 0.0, 0.0);
      const std::vector<double> now = scene.RenderWithPass();
      const std::vector<double> truth = scene.RenderWithRayCaster(64);
      const std::vector<bool> own = scene.NearEdges(2);
      for (std::size_t i = 0; i < now.size() && !before.empty(); ++i)
      {
        const double beyond = std::abs(now[i] - before[i]) - std::abs(truth[i] - truthBefore[i]);
        largest = own[i] ? largest : std::max(largest, 255.0 * beyond);
      }
      before = now;
      truthBefore = truth;
    }
    benchmark.Results.Add("a sphere crosses the border, 1 pixel a frame",
      "largest change beyond the reference's, 1/255", largest,
      margin < 0.0 ? TargetKind::AtMost : TargetKind::None, 2.0,
      margin < 0.0 ? "default margin" : "no margin");
  }
}

}

void MeasureMotion(ShaftBenchmark& benchmark)
{
  SweepLight(benchmark);
  CrossBorder(benchmark);
}

}
