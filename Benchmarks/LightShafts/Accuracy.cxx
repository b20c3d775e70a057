// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The pass against the marched reference in the same medium, without a fitted gain.
#include "Benchmark.h"
#include "ShaftScene.h"
#include "vtkPenumbraShaftConstants.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace penumbra
{

namespace
{

constexpr double WholeSphere = 4.0 * glm::pi<double>();
constexpr double EdgeDensity = 0.12; // scattering and extinction per world unit

/// A small number of steps, and one so large that only the missing depth layers cause errors. A
/// history of many jittered frames could attain an error between both.
constexpr int Steps[2] = { 16, 1024 };

/// Steps of the reference of the shadow maps.
constexpr int ReferenceSteps = 512;

/// Returns the RMS difference of two images over the pixels that are not excluded; all
/// pixels if `excluded` is empty.
double Rms(
  const std::vector<double>& a, const std::vector<double>& b, const std::vector<bool>& excluded)
{
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    if (excluded.empty() || !excluded[i])
    {
      sum += (a[i] - b[i]) * (a[i] - b[i]);
      count += 1.0;
    }
  }
  return std::sqrt(sum / std::max(count, 1.0));
}

double Correlation(const std::vector<double>& a, const std::vector<double>& b)
{
  const double n = static_cast<double>(a.size());
  double sums[5] = { 0.0, 0.0, 0.0, 0.0, 0.0 };
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const double terms[5] = { a[i], b[i], a[i] * a[i], b[i] * b[i], a[i] * b[i] };
    for (int k = 0; k < 5; ++k)
    {
      sums[k] += terms[k] / n;
    }
  }
  return (sums[4] - sums[0] * sums[1]) /
    std::sqrt((sums[2] - sums[0] * sums[0]) * (sums[3] - sums[1] * sums[1]));
}

/// Errors of the pass relative to the RMS of the reference.
struct Accuracy
{
  double All = 0.0;
  double AwayFromEdges = 0.0;
  double Unshadowed = 0.0;  ///< error of leaving the shadows out
  double Correlation = 0.0; ///< of the light removed by the shadows
};

Accuracy Compare(ShaftBenchmark& benchmark, ShaftScene& scene, const std::string& name)
{
  const std::vector<double> reference = scene.RenderWithRayCaster();
  const std::vector<double> image = scene.RenderWithPass();
  std::vector<double> unshadowed = scene.Transmittance();
  for (double& value : unshadowed)
  {
    value = (1.0 - value) / WholeSphere;
  }
  std::vector<double> shadowsOfReference(unshadowed.size()); // light that the shadows remove
  std::vector<double> shadowsOfImage(unshadowed.size());
  for (std::size_t i = 0; i < unshadowed.size(); ++i)
  {
    shadowsOfReference[i] = unshadowed[i] - reference[i];
    shadowsOfImage[i] = unshadowed[i] - image[i];
  }
  const std::vector<double> black(reference.size(), 0.0);
  const double norm = Rms(reference, black, {});
  Accuracy result;
  result.All = Rms(image, reference, {}) / norm;
  result.AwayFromEdges = Rms(image, reference, scene.NearEdges(3)) / norm;
  result.Unshadowed = Rms(unshadowed, reference, {}) / norm;
  result.Correlation = Correlation(shadowsOfReference, shadowsOfImage);
  if (benchmark.Diagnose)
  {
    WriteImage(benchmark.Output + "/" + name + ".png", { image, reference }, scene.Width);
  }
  std::printf("  %s: %.4f all, %.4f away from edges, %.4f without shadows, correlation %.4f\n",
    name.c_str(), result.All, result.AwayFromEdges, result.Unshadowed, result.Correlation);
  return result;
}

}

void WriteImage(const std::string& path, const std::vector<std::vector<double>>& parts, int width)
{
  const int count = static_cast<int>(parts.size());
  vtkNew<vtkImageData> image;
  image->SetDimensions(count * width, static_cast<int>(parts.front().size()) / width, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* bytes = static_cast<unsigned char*>(image->GetScalarPointer());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const vtkIdType x = i % (count * width);
    const vtkIdType y = i / (count * width);
    const double value = parts[x / width][y * width + x % width];
    bytes[i] = static_cast<unsigned char>(std::clamp(value * WholeSphere * 255.0, 0.0, 255.0));
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(image);
  writer->Write();
}

/// Posts in one actor, for which the pass by depth has an error of 0.13 at any tolerance.
void MeasureShadowMaps(ShaftBenchmark& benchmark)
{
  ShaftScene scene(256, 192);
  scene.AddComb(12);
  scene.Look({ 0.5, -11.0, 2.5 }, { 0.0, 0.0, 2.0 });
  scene.AddSun({ 0.2, 1.0, 0.32 });
  scene.SetMedium(EdgeDensity, EdgeDensity);
  const std::vector<double> truth = scene.RenderWithRayCaster(ReferenceSteps);
  const double size = Rms(truth, std::vector<double>(truth.size(), 0.0), {});
  const int inverses[3] = { 64, 256, 1024 };
  const double targets[3] = { 0.03, 0.015, 0.005 };
  std::vector<std::vector<double>> images;
  for (const bool mapped : { false, true })
  {
    scene.Pass->SetEstimator(
      mapped ? vtkPenumbraLightShaftPass::SHADOW_MAP : vtkPenumbraLightShaftPass::DEPTH);
    for (int i = 0; i < 3; ++i)
    {
      scene.Pass->SetTolerance(1.0 / inverses[i]);
      const std::vector<double> ours = scene.RenderWithPass();
      const std::string name = std::string(mapped ? "shadow map" : "depth") + " at tolerance 1/" +
        std::to_string(inverses[i]);
      benchmark.Results.Add("posts in one actor, sun in view", "relative RMSE, " + name,
        Rms(ours, truth, {}) / size, mapped ? TargetKind::AtMost : TargetKind::None,
        mapped ? targets[i] : 0.0);
      if (inverses[i] == 256)
      {
        images.push_back(ours);
      }
    }
  }
  if (benchmark.Diagnose)
  {
    images.push_back(truth);
    WriteImage(benchmark.Output + "/posts.png", images, scene.Width);
  }
}

void MeasureAccuracy(ShaftBenchmark& benchmark)
{
  MeasureShadowMaps(benchmark);
  ResultTable& table = benchmark.Results;
  Accuracy worst[2];
  double radial = 0.0;
  double bySteps[2] = { 0.0, 0.0 };
  for (const bool outside : { false, true })
  {
    Accuracy& worse = worst[outside];
    worse.Unshadowed = 1e30;
    worse.Correlation = 1.0;
    for (unsigned int seed = 1; seed <= 3; ++seed)
    {
      ShaftScene scene(256, 192);
      scene.AddFloor(12.0);
      scene.AddSolids(14, seed);
      scene.Look({ 0.5, -11.0, 2.5 }, { 0.0, 0.0, 2.0 });
      // Half the width of the image is 0.485 on the plane at distance 1.
      scene.AddSun({ outside ? 0.72 : 0.2, 1.0, 0.32 });
      scene.SetMedium(EdgeDensity, EdgeDensity);
      const std::string name = std::string(outside ? "outside-" : "inside-") + std::to_string(seed);
      const Accuracy one = Compare(benchmark, scene, name);
      worse.All = std::max(worse.All, one.All);
      worse.AwayFromEdges = std::max(worse.AwayFromEdges, one.AwayFromEdges);
      worse.Unshadowed = std::min(worse.Unshadowed, one.Unshadowed);
      worse.Correlation = std::min(worse.Correlation, one.Correlation);
      if (!outside)
      {
        for (int i = 0; i < 2; ++i)
        {
          scene.Pass->GetConstants().Steps = Steps[i];
          const double error =
            Compare(benchmark, scene, name + "-" + std::to_string(Steps[i]) + "-steps").All;
          bySteps[i] = std::max(bySteps[i], error);
        }
        scene.Pass->GetConstants().Steps = 0;
        scene.Pass->SetEstimator(vtkPenumbraLightShaftPass::RADIAL);
        radial = std::max(radial, Compare(benchmark, scene, name + "-radial").All);
      }
    }
  }
  const std::string inside = "boxes and spheres, sun in view, worst of 3";
  table.Add(inside, "relative RMSE", worst[0].All, TargetKind::AtMost, 0.025);
  table.Add(inside, "relative RMSE more than 3 pixels from edges", worst[0].AwayFromEdges,
    TargetKind::AtMost, 0.02);
  table.Add(inside, "error / error without shadows", worst[0].All / worst[0].Unshadowed,
    TargetKind::AtMost, 0.25);
  table.Add(
    inside, "correlation of the missing light", worst[0].Correlation, TargetKind::AtLeast, 0.95);
  for (int i = 0; i < 2; ++i)
  {
    table.Add(inside, "relative RMSE with " + std::to_string(Steps[i]) + " steps", bySteps[i],
      TargetKind::None);
  }
  table.Add(inside, "relative RMSE of the paper's mean of a mask", radial, TargetKind::None);
  const std::string outside = "the same, sun 48 % outside of the image";
  table.Add(outside, "relative RMSE", worst[1].All, TargetKind::AtMost, 0.035);
}

}
