// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// penumbra compare: computes the difference between an image and its baselines.
#include "Files/AtomicFile.h"
#include "Files/ImageFiles.h"
#include "Files/InputFiles.h"
#include "Files/Report.h"
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

namespace penumbra
{

namespace
{

struct CompareOptions
{
  std::vector<std::string> Images;
  std::string Metric = "rmse";
  double Threshold = std::nan("");
  double Tolerance = std::nan("");
  std::string Mask;
  std::string Difference;
  bool Json = false;
};

int FindMetric(const std::string& name)
{
  int metric = 0;
  while (name != vtkPenumbraImageComparison::GetMetricName(metric))
  {
    ++metric;
  }
  return metric;
}

// Scales the difference so that its largest value is 1, because 8 bits resolve small differences badly.
// Returns the factor.
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
  return ReadImage(path);
}

// Runs in a worker process.
int Compare(const CompareOptions& options)
{
  for (const std::string& image : options.Images)
  {
    RecordInput(image);
  }
  RecordInput(options.Mask);
  std::unique_ptr<AtomicFile> file;
  if (!options.Difference.empty())
  {
    CheckImageExtension(options.Difference, "--difference");
    file = std::make_unique<AtomicFile>(options.Difference, "--difference");
  }
  const bool usesTolerance = !std::isnan(options.Tolerance);
  const std::string name = usesTolerance ? "excess" : options.Metric;
  const double threshold = usesTolerance ? 1.0 : options.Threshold;
  const int metric = FindMetric(name);
  vtkNew<vtkPenumbraImageComparison> comparison;
  comparison->SetMetric(metric);
  if (usesTolerance)
  {
    comparison->SetTolerance(options.Tolerance);
  }
  if (!options.Mask.empty())
  {
    comparison->SetMask(Read(options.Mask));
  }
  comparison->SetImage(Read(options.Images[0]));
  for (std::size_t i = 1; i < options.Images.size(); ++i)
  {
    comparison->AddBaseline(Read(options.Images[i]));
  }
  EnterPhase("comparing " + options.Images[0], Unavailable);
  if (!comparison->Compare())
  {
    throw CommandError(BadInput,
      options.Images[0] + ": " + comparison->GetErrorText() +
        "; images and mask must have the same size, and the mask must have at least one pixel that "
        "is not black");
  }
  double factor = 1.0;
  if (file)
  {
    const vtkSmartPointer<vtkImageData> difference = comparison->MakeDifference();
    factor = HoldsArrays(options.Difference) ? 1.0 : Amplify(difference);
    WriteImage(difference, *file, options.Difference, false, 72);
    file->Commit();
  }

  const double value = comparison->GetValue(metric);
  const std::string& nearest = options.Images[1 + comparison->GetBestBaseline()];
  const bool above = value > threshold;
  if (options.Json)
  {
    ReportTable metrics;
    for (int each = 0; each < vtkPenumbraImageComparison::NUMBER_OF_METRICS; ++each)
    {
      metrics[vtkPenumbraImageComparison::GetMetricName(each)] = comparison->GetValue(each);
    }
    Report report = { { "metric", name }, { "value", value }, { "baseline", nearest },
      { "above_threshold", above }, { "metrics", metrics } };
    if (!std::isnan(threshold))
    {
      report["threshold"] = threshold;
    }
    if (file)
    {
      report["difference_factor"] = factor;
    }
    std::cout << FormatJson(report);
    return above ? AboveThreshold : Done;
  }
  std::cout << name << " " << value << " from " << nearest;
  if (!std::isnan(threshold))
  {
    std::cout << (above ? ", above " : ", within ") << threshold;
  }
  if (factor != 1.0)
  {
    std::cout << ", difference amplified " << factor << " times";
  }
  std::cout << "\n";
  return above ? AboveThreshold : Done;
}

}

Action DeclareCompare(const CommandLine& program)
{
  const auto options = std::make_shared<CompareOptions>();
  const CommandLine app =
    program.AddSubcommand("compare", "Compare an image with the nearest of its baselines");
  app.AddTexts("IMAGE", options->Images, "Image, then one or more baselines")
    .Required()
    .TypeName("A B...");
  AddChoice(app, "--metric", options->Metric,
    { "rmse", "max", "ssim", "pixels", "tile-rmse", "tile-pixels", "excess" },
    "rmse: root mean square; max: largest difference; ssim: 1 - structural similarity; pixels: "
    "fraction that differs by more than 4/255; tile-rmse, tile-pixels: of the worst 16x16 pixels; "
    "excess: ratio to the limits of --tolerance");
  AddNumber(app, "--threshold", options->Threshold, "X", "Exit with 1 if the metric is above X",
    { 0.0, Infinity });
  AddNumber(app, "--tolerance", options->Tolerance, "X",
    "Instead of a metric and a threshold: exit with 1 unless tile-rmse is at most X, at most 1 % "
    "of the pixels differ by more than 4/255, and at most 1/32 of any 16x16 pixels; 1/16 suits "
    "OpenGL images",
    { 0.0, 1.0 });
  app.AddText("--mask", options->Mask, "PATH", "Image of the same size; black pixels are ignored");
  app.AddText("--difference", options->Difference, "PATH",
    "Write an image of the differences; 8-bit formats are scaled so that the largest difference "
    "is white");
  AddReadLimitOption(app);
  app.AddFlag("--json", options->Json, "Print all metrics as JSON");
  return [options]() {
    if (options->Images.size() < 2)
    {
      throw CommandError(BadInput, "compare: give an image and at least one baseline");
    }
    return RunWorkers(
      1, 1, [&](int) { return Compare(*options); }, [](int) {});
  };
}

}
