// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Light shafts in motion: in-scattered radiance as a fraction of its maximum.
#include "Benchmark.h"
#include "ShaftScene.h"
#include "vtkPenumbraShaftConstants.h"

#include "vtkActor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace penumbra
{

namespace
{

constexpr double EdgeDensity = 0.12;

/// Radiance of an infinitely long, fully lit ray in a medium with isotropic scattering and without
/// absorption, for a light of irradiance 1: the maximum.
constexpr double MaximumRadiance = 0.07957747154594767;

using Image = std::vector<double>;

/// Largest change of a pixel between two frames.
double LargestChange(const Image& before, const Image& now)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < now.size(); ++i)
  {
    const double change = std::abs(now[i] - before[i]) / MaximumRadiance;
    largest = change <= largest ? largest : std::isfinite(change) ? change : 1e30;
  }
  return largest;
}

/// RMS over pixels of the error of the change between two frames.
double ErrorOfChange(
  const Image& before, const Image& now, const Image& truthBefore, const Image& truth)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < now.size(); ++i)
  {
    const double error = now[i] - before[i] - (truth[i] - truthBefore[i]);
    sum += error * error;
  }
  const double rms = std::sqrt(sum / static_cast<double>(now.size())) / MaximumRadiance;
  return std::isfinite(rms) ? rms : 1e30;
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
  const int estimators[2] = { vtkPenumbraLightShaftPass::DEPTH, vtkPenumbraLightShaftPass::RADIAL };
  Image before[2];
  Image truthBefore;
  std::vector<Image> strip;
  double largest = 0.0;
  double largestOfTruth = 0.0;
  double worst[2] = { 0.0, 0.0 };
  int worstAngle = 0;
  // The image ends 26 degrees from its center.
  for (int angle = 36; angle <= 180; ++angle)
  {
    const double a = angle * 0.017453292519943295;
    sun->SetPosition(std::sin(a), std::cos(a), 0.2);
    const Image truth = scene.RenderWithRayCaster(64);
    for (const int i : { 1, 0 })
    {
      scene.Pass->SetEstimator(estimators[i]);
      const Image now = scene.RenderWithPass();
      if (!truthBefore.empty())
      {
        const double error = ErrorOfChange(before[i], now, truthBefore, truth);
        worstAngle = i == 0 && error > worst[0] ? angle : worstAngle;
        worst[i] = std::max(worst[i], error);
        largest = i == 0 ? std::max(largest, LargestChange(before[0], now)) : largest;
      }
      before[i] = now;
    }
    largestOfTruth =
      truthBefore.empty() ? 0.0 : std::max(largestOfTruth, LargestChange(truthBefore, truth));
    truthBefore = truth;
    if (angle % 24 == 12)
    {
      strip.push_back(before[0]);
    }
  }
  if (benchmark.Diagnose)
  {
    WriteImage(benchmark.Output + "/sweep.png", strip, scene.Width);
  }
  const std::string row = "light from 10 degrees outside to 180, 1 degree per frame";
  benchmark.Results.Add(row, "RMS error of the change per frame, worst frame", worst[0],
    TargetKind::AtMost, 0.01, "at " + std::to_string(worstAngle) + " degrees");
  benchmark.Results.Add(row, "RMS error of the change per frame, worst frame, mask of [Shafts]",
    worst[1], TargetKind::None);
  benchmark.Results.Add(row, "largest change of a pixel", largest, TargetKind::None);
  benchmark.Results.Add(
    row, "largest change of a pixel of the reference", largestOfTruth, TargetKind::None);
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
    scene.Pass->GetConstants().Margin = margin;
    Image before;
    Image truthBefore;
    double change = 0.0;
    double error = 0.0;
    for (int frame = 0; frame < 40; ++frame)
    {
      // A pixel is 11 * 0.728 / 120 world units at the distance of the sphere.
      ball->SetPosition(4.2 + 0.0667 * frame, 0.0, 0.0);
      const Image now = scene.RenderWithPass();
      const Image truth = scene.RenderWithRayCaster(64);
      const Image none(now.size(), 0.0);
      error = std::max(error, ErrorOfChange(none, now, none, truth));
      change =
        before.empty() ? change : std::max(change, ErrorOfChange(before, now, truthBefore, truth));
      before = now;
      truthBefore = truth;
    }
    const bool isDefault = margin < 0.0;
    const std::string row = "a sphere crosses the border, 1 pixel per frame";
    const char* remark = isDefault ? "default margin" : "no margin";
    benchmark.Results.Add(row, "RMSE of the worst frame", error,
      isDefault ? TargetKind::AtMost : TargetKind::None, 0.02, remark);
    benchmark.Results.Add(
      row, "RMS error of the change per frame, worst frame", change, TargetKind::None, 0.0, remark);
  }
}

}

void MeasureMotion(ShaftBenchmark& benchmark)
{
  SweepLight(benchmark);
  CrossBorder(benchmark);
}

}
