// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// penumbra compare: how far a picture is from its baselines.
#include "Files/AtomicFile.h"
#include "Files/ImageFiles.h"
#include "Files/InputFiles.h"
#include "Input/ReadLimit.h"
#include "Parsing/Arguments.h"
#include "Processes/CommandError.h"
#include "Processes/Worker.h"
#include "Subcommands.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPenumbraImageComparison.h"
#include "vtkPointData.h"

#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

namespace penumbra
{

namespace
{

struct CompareOptions
{
  std::vector<std::string> Pictures;
  std::string Metric = "rmse";
  double Threshold = std::nan("");
  double Tolerance = std::nan("");
  std::string Mask;
  std::string Difference;
  bool Json = false;
};

int MetricOf(const std::string& name)
{
  int metric = 0;
  while (name != vtkPenumbraImageComparison::GetMetricName(metric))
  {
    ++metric;
  }
  return metric;
}

// 8 bits show a small difference badly: the largest becomes white. Returns the factor.
double Amplify(vtkImageData* difference)
{
  vtkDataArray* color = difference->GetPointData()->GetArray("Color");
  double largest = 0.0;
  for (int c = 0; c < 3; ++c)
  {
    largest = std::max(largest, color->GetRange(c)[1]);
  }
  const double factor = largest > 0.0 ? 1.0 / largest : 1.0;
  for (vtkIdType i = 0; i < color->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      color->SetComponent(i, c, color->GetComponent(i, c) * factor);
    }
  }
  return factor;
}

vtkSmartPointer<vtkImageData> Read(const std::string& path)
{
  EnterPhase(path, BadInput);
  const ReadLimit limit(path);
  return ReadPicture(path);
}

// In a process of its own.
int Compare(const CompareOptions& options)
{
  for (const std::string& picture : options.Pictures)
  {
    RecordInput(picture);
  }
  RecordInput(options.Mask);
  std::unique_ptr<AtomicFile> file;
  if (!options.Difference.empty())
  {
    CheckPictureExtension(options.Difference, "--difference");
    file = std::make_unique<AtomicFile>(options.Difference, "--difference");
  }
  const bool asksForNearness = !std::isnan(options.Tolerance);
  const std::string name = asksForNearness ? "excess" : options.Metric;
  const double threshold = asksForNearness ? 1.0 : options.Threshold;
  const int metric = MetricOf(name);
  vtkNew<vtkPenumbraImageComparison> comparison;
  comparison->SetMetric(metric);
  if (asksForNearness)
  {
    comparison->SetTolerance(options.Tolerance);
  }
  if (!options.Mask.empty())
  {
    comparison->SetMask(Read(options.Mask));
  }
  comparison->SetImage(Read(options.Pictures[0]));
  for (std::size_t i = 1; i < options.Pictures.size(); ++i)
  {
    comparison->AddBaseline(Read(options.Pictures[i]));
  }
  EnterPhase("comparing " + options.Pictures[0], Unavailable);
  if (!comparison->Compare())
  {
    throw CommandError(BadInput,
      options.Pictures[0] + ": " + comparison->GetErrorText() + "; give pictures that match");
  }
  double factor = 1.0;
  if (file)
  {
    const vtkSmartPointer<vtkImageData> difference = comparison->MakeDifference();
    factor = HoldsArrays(options.Difference) ? 1.0 : Amplify(difference);
    WritePicture(difference, *file, options.Difference, false, 72);
    file->Commit();
  }

  const double value = comparison->GetValue(metric);
  const std::string& nearest = options.Pictures[1 + comparison->GetBestBaseline()];
  const bool above = value > threshold;
  if (options.Json)
  {
    nlohmann::json report = { { "metric", name }, { "value", value }, { "baseline", nearest },
      { "above_threshold", above } };
    for (int each = 0; each < vtkPenumbraImageComparison::NUMBER_OF_METRICS; ++each)
    {
      report["metrics"][vtkPenumbraImageComparison::GetMetricName(each)] =
        comparison->GetValue(each);
    }
    if (!std::isnan(threshold))
    {
      report["threshold"] = threshold;
    }
    if (file)
    {
      report["difference_factor"] = factor;
    }
    std::cout << report.dump(2) << "\n";
    return above ? AboveThreshold : Done;
  }
  std::cout << name << " " << value << " from " << nearest;
  if (!std::isnan(threshold))
  {
    std::cout << (above ? ", above " : ", within ") << threshold;
  }
  if (factor != 1.0)
  {
    std::cout << ", difference shown " << factor << " times";
  }
  std::cout << "\n";
  return above ? AboveThreshold : Done;
}

}

Action DeclareCompare(CLI::App& program)
{
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* app = program.add_subcommand(
    "compare", "Tell how far a picture is from the nearest of its baselines");
  app->add_option("PICTURE", options->Pictures, "The picture, then one or more baselines")
    ->required()
    ->type_name("A B...");
  AddChoice(*app, "--metric", options->Metric,
    { "rmse", "max", "ssim", "pixels", "tile-rmse", "tile-pixels", "excess" },
    "rmse: root mean square; max: largest difference; ssim: 1 - structural similarity; pixels: "
    "share off by more than 4/255; tile-rmse, tile-pixels: of the worst 16x16 pixels; excess: over "
    "the limits of --tolerance");
  AddNumber(*app, "--threshold", options->Threshold, "X", "Exit with 1 when the metric is above",
    { 0.0, Infinity });
  AddNumber(*app, "--tolerance", options->Tolerance, "X",
    "Instead of a metric and a threshold: exit with 1 unless near, which is at most X as "
    "tile-rmse, "
    "1 % of the pixels off, and 1/32 of any 16x16; 1/16 suits pictures of OpenGL",
    { 0.0, 1.0 });
  app
    ->add_option(
      "--mask", options->Mask, "A picture of the same size: what is black in it does not count")
    ->type_name("PATH")
    ->take_last();
  app
    ->add_option("--difference", options->Difference,
      "Write a picture of the differences; 8 bit: the largest is white")
    ->type_name("PATH")
    ->take_last();
  AddReadLimitOption(*app);
  app->add_flag("--json", options->Json, "Print all metrics as JSON");
  return [options]() {
    if (options->Pictures.size() < 2)
    {
      throw CommandError(BadInput, "compare: give a picture and at least one baseline");
    }
    return RunWorkers(
      1, 1, [&](int) { return Compare(*options); }, [](int) {});
  };
}

}
