// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// `penumbra render --ambient-occlusion` with both engines.
#include "Program.h"
#include "RenderedImages.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace penumbra_testing;

TEST(Render, EnginesComputeSimilarOcclusion)
{
  const Folder folder("occlusion");
  const std::vector<std::string> scene = { SourceFolder() + "/Data/bracket.stl", "--resolution",
    "120,90", "--camera-direction=-1,-1,-2", "--ambient-occlusion" };
  std::vector<std::string> ray = { "render", "--output", folder / "ray.vti", "--tolerance",
    "0.05" };
  ray.insert(ray.end(), scene.begin(), scene.end());
  std::vector<std::string> raster = { "render", "--output", folder / "raster.vti", "--engine",
    "raster", "--statistics", folder / "raster.json" };
  raster.insert(raster.end(), scene.begin(), scene.end());
  ASSERT_EQ(RunProgram(ray).Status, 0);
  const ProgramResult outcome = RunProgram(raster);
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(outcome.Errors, "");
  const auto traced = ReadImage(folder / "ray.vti");
  const auto drawn = ReadImage(folder / "raster.vti");
  double errors[2] = { 0.0, 0.0 };
  int pixels = 0;
  const char* const names[2] = { "Depth", "AmbientOcclusion" };
  for (vtkIdType i = 0; i < traced->GetNumberOfPoints(); ++i)
  {
    // Pixels on a silhouette show one of two surfaces.
    const double depth = traced->GetPointData()->GetArray("Depth")->GetComponent(i, 0);
    const double drawnDepth = drawn->GetPointData()->GetArray("Depth")->GetComponent(i, 0);
    if (std::isfinite(depth) && std::abs(drawnDepth / depth - 1.0) < 0.01)
    {
      ++pixels;
      for (int k = 0; k < 2; ++k)
      {
        const double difference = traced->GetPointData()->GetArray(names[k])->GetComponent(i, 0) -
          drawn->GetPointData()->GetArray(names[k])->GetComponent(i, 0);
        errors[k] += difference * difference;
      }
    }
  }
  EXPECT_GT(pixels, 2000);
  EXPECT_LT(std::sqrt(errors[0] / pixels), 0.5); // of a part 100 units wide
  EXPECT_LT(std::sqrt(errors[1] / pixels), 0.15);
  const Json report = ReadJson(folder / "raster.json");
  EXPECT_EQ(report["statistics"]["Occlusion/Kernel"], "traced");
  EXPECT_LE(report["estimated_error"], 0.01);
  EXPECT_EQ(report["tolerance"], 0.01);
  raster.insert(raster.end(), { "--tolerance", "0.004" });
  ASSERT_EQ(RunProgram(raster).Status, 0);
  const Json fine = ReadJson(folder / "raster.json");
  EXPECT_EQ(fine["tolerance"], 0.004);
  EXPECT_LE(fine["estimated_error"], 0.004);
  EXPECT_GT(fine["statistics"]["Samples/Static"], report["statistics"]["Samples/Static"]);
}

TEST(Render, LightAwarenessReducesDarkeningOfBrightColors)
{
  const Folder folder("awareness");
  const ProgramResult outcome = RunProgram({ "render", SourceFolder() + "/Data/bracket.stl",
    "--resolution", "240,180", "--camera-direction=-1,-1,-2", "--no-lighting", "--color",
    "0.8,0.4,0.2", "--engine", "raster", "--ambient-occlusion", "--ambient-occlusion-kernel",
    "horizon", "--ambient-occlusion-light-awareness", "0.5", "--output", folder / "p.vti" });
  ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
  EXPECT_EQ(outcome.Errors, "");
  const auto image = ReadImage(folder / "p.vti");
  vtkDataArray* colors = image->GetPointData()->GetArray("Color");
  vtkDataArray* occlusions = image->GetPointData()->GetArray("AmbientOcclusion");
  int dark = 0;
  int right = 0;
  const int width = image->GetDimensions()[0];
  for (vtkIdType i = width + 1; i < image->GetNumberOfPoints() - width - 1; ++i)
  {
    const double occlusion = occlusions->GetComponent(i, 0);
    const double factor = 1.0 - occlusion * (1.0 - 0.5 * 0.8);
    // Along edges, the samples of a pixel show surfaces with different occlusion.
    bool isDark = occlusion > 0.2;
    for (const int step : { -width - 1, -width, -width + 1, -1, 1, width - 1, width, width + 1 })
    {
      isDark = isDark && std::abs(occlusions->GetComponent(i + step, 0) - occlusion) < 0.1;
    }
    dark += isDark;
    right += isDark && std::abs(colors->GetComponent(i, 0) - 0.8 * factor) < 0.01 &&
      std::abs(colors->GetComponent(i, 2) - 0.2 * factor) < 0.01;
  }
  EXPECT_GT(dark, 100);
  EXPECT_GT(right, 0.95 * dark);
}

TEST(Render, GatherersComputeSimilarOcclusion)
{
  const Folder folder("gatherers");
  for (const char* gatherer : { "rays", "cube-map" })
  {
    const ProgramResult outcome = RunProgram({ "render", SourceFolder() + "/Data/bracket.stl",
      "--resolution", "160,120", "--camera-direction=-1,-1,-2", "--ambient-occlusion",
      "--ambient-occlusion-radius", "inf", "--tolerance", "0.02", "--cache", "world", "--gatherer",
      gatherer, "--statistics", folder / "s.json", "--output", folder / gatherer + ".png" });
    if (outcome.Status == 3)
    {
      GTEST_SKIP() << outcome.Errors;
    }
    ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
    EXPECT_EQ(outcome.Errors, "");
  }
  const Json drawn = ReadJson(folder / "s.json")["statistics"];
  EXPECT_GT(drawn["CubeMaps/Total"], 100);
  EXPECT_LT(drawn["Rays/Gather"], 100 * drawn["CubeMaps/Total"]);
  EXPECT_LT(
    Compare(folder / "rays.png", folder / "cube-map.png", vtkPenumbraImageComparison::RMSE), 0.01);
}

TEST(Render, AppliesNamedFalloff)
{
  const Folder folder("falloff");
  double last = 1.0;
  for (const char* falloff :
    { "none", "quadratic", "linear", "square-root" }) // decreasing occlusion
  {
    const ProgramResult outcome = RunProgram({ "render", SourceFolder() + "/Data/bracket.stl",
      "--resolution", "60,40", "--camera-direction=-1,-1,-2", "--tolerance", "0.05",
      "--ambient-occlusion-falloff", falloff, "--output", folder / "p.vti" });
    ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
    EXPECT_EQ(outcome.Errors, "");
    const auto image = ReadImage(folder / "p.vti");
    vtkDataArray* occlusion = image->GetPointData()->GetArray("AmbientOcclusion");
    double mean = 0.0;
    for (vtkIdType i = 0; i < occlusion->GetNumberOfTuples(); ++i)
    {
      mean += occlusion->GetComponent(i, 0) / static_cast<double>(occlusion->GetNumberOfTuples());
    }
    EXPECT_LT(mean, .9 * last) << falloff;
    EXPECT_GT(mean, .005) << falloff;
    last = mean;
  }
}

// Frames of a window take as many rays as fit into a time; those of the program do not.
TEST(Render, MakesTheSameImageInANumberOfFramesOnAnyNumberOfThreads)
{
  const Folder folder("frames");
  std::vector<std::vector<unsigned char>> images;
  std::vector<double> samples;
  for (const std::string threads : { "1", "2" })
  {
    const std::string report = folder / (threads + ".json");
    const std::string image = folder / (threads + ".png");
    const ProgramResult outcome = RunProgram({ "render", SourceFolder() + "/Data/head.ply",
      "--resolution", "160,120", "--engine", "raster", "--ambient-occlusion", "--frames", "4",
      "--threads", threads, "--output", image, "--statistics", report });
    ASSERT_EQ(outcome.Status, 0) << outcome.Errors;
    const Json statistics = ReadJson(report)["statistics"];
    EXPECT_EQ(statistics["Occlusion/Kernel"], "traced");
    samples.push_back(statistics["Samples/Static"]);
    const auto drawn = ReadImage(image);
    vtkDataArray* colors = drawn->GetPointData()->GetScalars();
    images.emplace_back();
    for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
    {
      for (int c = 0; c < colors->GetNumberOfComponents(); ++c)
      {
        images.back().push_back(static_cast<unsigned char>(colors->GetComponent(i, c)));
      }
    }
  }
  EXPECT_EQ(samples[0], samples[1]);
  EXPECT_EQ(images[0], images[1]);
}
