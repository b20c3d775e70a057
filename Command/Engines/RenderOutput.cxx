// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RenderOutput.h"

#include "CollectionItems.h"
#include "Files/ImageFiles.h"
#include "Files/InputFiles.h"
#include "Files/Report.h"
#include "Input/DataSetValidation.h"
#include "Options/RenderOptions.h"
#include "Processes/CommandError.h"
#include "Processes/ProgressLine.h"
#include "Processes/Worker.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkMapper.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <filesystem>

namespace penumbra
{

namespace
{

// Returns whether every pixel has the color of the background, or is transparent.
bool ShowsOnlyBackground(vtkImageData* image, vtkRenderer* renderer, bool background)
{
  vtkDataArray* color = image->GetPointData()->GetArray("Color");
  if (!background)
  {
    return color->GetRange(3)[1] <= 0.0;
  }
  const double* expected = renderer->GetBackground();
  for (int c = 0; c < 3; ++c)
  {
    const double* range = color->GetRange(c);
    if (std::max(expected[c] - range[0], range[1] - expected[c]) > 0.5 / 255.0)
    {
      return false;
    }
  }
  return true;
}

/// Returns whether all surfaces have zero area, which is reported when they are read.
bool ShowsOnlyZeroArea(vtkRenderer* renderer)
{
  const std::vector<vtkActor*> actors = GetItems<vtkActor>(renderer->GetActors());
  return std::all_of(actors.begin(), actors.end(), [](vtkActor* actor) {
    auto* mesh = vtkPolyData::SafeDownCast(actor->GetMapper()->GetInput());
    return mesh && HasOnlyZeroArea(mesh);
  });
}

// Returns the reason why an image shows no surface; empty if it shows one.
std::string DescribeEmptyImage(
  const RenderResult& result, vtkRenderer* renderer, const RenderOptions& options)
{
  const bool empty = result.Coverage == RenderResult::Coverages::Empty;
  // The image of a figure lacks its lines.
  if (!empty && !result.VectorGraphics.empty())
  {
    return std::string();
  }
  if (!empty && !ShowsOnlyBackground(result.Image, renderer, options.Background))
  {
    return std::string();
  }
  if (renderer->GetActors()->GetNumberOfItems() == 0)
  {
    return "the time step is empty";
  }
  if (ShowsOnlyZeroArea(renderer))
  {
    return std::string();
  }
  if (options.Opacity == 0.0)
  {
    return "all surfaces are transparent and the image shows only the background; raise --opacity";
  }
  if (empty)
  {
    return "no surface is in view; check the --camera options";
  }
  return result.Coverage == RenderResult::Coverages::Unknown
    ? "the image shows only the background; check the --camera options, the colors and the lights"
    : "the surfaces in view have the color of the background; check the colors and the lights";
}

}

InputOptions GetInputOptions(
  const RenderOptions& options, std::optional<double> time, bool allowEmpty)
{
  return { time, options.Materials, allowEmpty,
    { options.Cuts, options.Coloring.Array, options.Coloring.ByCells } };
}

Surfaces ReadMeshes(const std::vector<std::string>& files, const InputOptions& input,
  ProgressLine& progress, std::vector<std::string>& warnings)
{
  Surfaces all;
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    progress.Show("reading", static_cast<double>(i) / files.size());
    EnterPhase(files[i], BadInput);
    all.Append(ReadSurfaces(files[i], input));
  }
  warnings.insert(warnings.end(), all.Warnings.begin(), all.Warnings.end());
  return all;
}

OutputFiles::OutputFiles(const RenderOptions& options)
  : Output(options.Output, "--output")
{
  if (!options.Statistics.empty())
  {
    this->Statistics.emplace(options.Statistics, "--statistics");
  }
}

std::vector<std::string> OutputFiles::Save(const RenderResult& result, vtkRenderer* renderer,
  const RenderOptions& options, const PhaseTimes& preparation, const std::string& note)
{
  std::vector<std::string> warnings = result.Warnings;
  const std::string reason = DescribeEmptyImage(result, renderer, options);
  if (!reason.empty())
  {
    warnings.push_back(reason);
  }
  EnterPhase("writing " + options.Output, Unavailable);
  const Clock::time_point lap = Clock::now();
  if (IsVectorGraphic(options.Output))
  {
    this->Output.Write(result.VectorGraphics);
  }
  else
  {
    WriteImage(
      result.Image, this->Output, options.Output, !options.Background, options.DotsPerInch, note);
  }
  const double writeSeconds = SecondsSince(lap);
  if (this->Statistics)
  {
    const ReportTable seconds = { { "read", preparation.ReadSeconds },
      { "build", preparation.SceneSeconds + result.BuildSeconds },
      { "render", result.RenderSeconds }, { "write", writeSeconds },
      { "total", SecondsSince(preparation.Start) } };
    const Report report = { { "statistics", result.Statistics },
      { "estimated_error", result.EstimatedError },
      { "estimated_light_error", result.EstimatedLightError }, { "tolerance", result.Tolerance },
      { "light_tolerance", result.LightTolerance }, { "threads", result.Threads },
      { "seconds", seconds }, { "peak_memory_bytes", PeakMemory() } };
    this->Statistics->Write(FormatJson(report));
    this->Statistics->Commit();
  }
  this->Output.Commit();
  return warnings;
}

void RecordInputs(const RenderOptions& options)
{
  for (const std::string& file : options.Files)
  {
    RecordInput(file);
  }
  RecordInput(options.Light.EnvironmentFile);
}

void CreateFolders(const RenderOptions& options)
{
  for (const auto& [option, path] :
    { std::pair("--output ", options.Output), { "--statistics ", options.Statistics } })
  {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    std::error_code error;
    if (!folder.empty() && !std::filesystem::create_directories(folder, error) && error)
    {
      const std::string broken = DescribeBrokenLink(folder.string());
      throw CommandError(BadInput,
        option + path +
          ": the folder cannot be created: " + (broken.empty() ? error.message() : broken));
    }
  }
}

void CheckFiles(const RenderOptions& options)
{
  RefuseInput(options.Output, "--output");
  if (options.Statistics.empty())
  {
    return;
  }
  RefuseInput(options.Statistics, "--statistics");
  std::error_code ignored;
  if (std::filesystem::weakly_canonical(options.Statistics, ignored) ==
    std::filesystem::weakly_canonical(options.Output, ignored))
  {
    throw CommandError(BadInput,
      "--statistics " + options.Statistics + ": the path equals --output; choose another file");
  }
}

}
