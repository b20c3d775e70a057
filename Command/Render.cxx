// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// penumbra render: renders meshes to images.
#include "Engines/Engine.h"
#include "Engines/RenderOutput.h"
#include "Files/Report.h"
#include "Options/RenderOptions.h"
#include "Processes/CommandError.h"
#include "Processes/MessageLog.h"
#include "Processes/ProgressLine.h"
#include "Processes/Worker.h"
#include "Scene/SceneBuilder.h"
#include "Subcommands.h"

#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <set>

namespace penumbra
{

namespace
{

// Placeholders for the name of a file; the second one is F3D's.
const std::string NamePlaceholders[] = { "{name}", "{model}" };

std::string ReplaceName(const std::string& pattern, const std::string& file)
{
  const std::string name = std::filesystem::path(file).stem().string();
  std::string path = pattern;
  for (const std::string& placeholder : NamePlaceholders)
  {
    path = ReplaceAll(path, placeholder, name);
  }
  return path;
}

bool HasName(const std::string& pattern)
{
  return std::any_of(std::begin(NamePlaceholders), std::end(NamePlaceholders),
    [&](const std::string& placeholder) { return pattern.find(placeholder) != std::string::npos; });
}

// Renders one image, in a worker process.
int RenderImage(const RenderOptions& options, Clock::time_point start)
{
  OutputFiles files(options);
  const bool rays = options.Engine == "ray";
  ChooseWindowFor(options);
  if (options.Threads > 0)
  {
    vtkSMPTools::Initialize(options.Threads);
  }

  ProgressLine progress(options.Progress);
  PhaseTimes preparation{ start };
  std::vector<std::string> warnings;
  Clock::time_point lap = Clock::now();
  const auto meshes = ReadMeshes(options.Files, progress, warnings);
  preparation.ReadSeconds = SecondsSince(lap);

  EnterPhase("rendering " + options.Output, Unavailable);
  lap = Clock::now();
  const vtkSmartPointer<vtkRenderer> renderer =
    BuildScene(meshes, options, rays ? 1.0 : options.DotsPerInch / 72.0);
  preparation.SceneSeconds = SecondsSince(lap);
  const auto listener = [&progress](double fraction) { progress.Show("rendering", fraction); };
  const RenderResult result =
    rays ? RenderWithRays(renderer, options, listener) : PrepareRaster(renderer, options)(listener);
  progress.Show("writing", 1.0);
  const std::vector<std::string> more = files.Save(result, renderer, options, preparation);
  warnings.insert(warnings.end(), more.begin(), more.end());
  progress.Clear();
  PrintWarnings(warnings);
  return Done;
}

// Returns the options of each image: one for all files, or one per file if the output path contains {name}.
std::vector<RenderOptions> PlanImages(const RenderOptions& options)
{
  if (!HasName(options.Output))
  {
    if (HasName(options.Statistics))
    {
      throw CommandError(BadInput, "--statistics may contain {name} only if --output contains it");
    }
    return { options };
  }
  if (options.Files.size() > 1 && !options.Statistics.empty() && !HasName(options.Statistics))
  {
    throw CommandError(BadInput,
      "--statistics " + options.Statistics + ": the path must contain {name}, one file per image");
  }
  std::vector<RenderOptions> images;
  std::set<std::string> outputs;
  for (const std::string& file : options.Files)
  {
    RenderOptions one = options;
    one.Files = { file };
    one.Output = ReplaceName(options.Output, file);
    one.Statistics = ReplaceName(options.Statistics, file);
    if (options.Files.size() > 1)
    {
      one.Progress = "none";
    }
    if (!outputs.insert(one.Output).second)
    {
      throw CommandError(BadInput,
        file + ": another file has the same output " + one.Output + "; rename one of the two");
    }
    images.push_back(one);
  }
  return images;
}

int Render(const RenderOptions& options, Clock::time_point start)
{
  std::vector<RenderOptions> images = PlanImages(options);
  RecordInputs(options);
  for (const RenderOptions& image : images)
  {
    CheckFiles(image);
  }
  const int count = static_cast<int>(images.size());
  const int jobs = std::min(options.Jobs, count);
  if (jobs > 1 && options.Threads == 0)
  {
    const int threads = std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads() / jobs);
    for (RenderOptions& image : images)
    {
      image.Threads = threads;
    }
  }
  std::unique_ptr<ProgressLine> progress;
  if (count > 1)
  {
    progress = std::make_unique<ProgressLine>(options.Progress);
  }
  const auto finished = [&progress, count](int done) {
    if (progress)
    {
      progress->Show(std::to_string(done) + " of " + std::to_string(count) + " images",
        static_cast<double>(done) / count);
    }
  };
  return RunWorkers(
    count, jobs, [&](int i) { return RenderImage(images[i], start); }, finished);
}

}

Action DeclareRender(const CommandLine& program)
{
  const Clock::time_point start = Clock::now();
  const auto options = std::make_shared<RenderOptions>();
  const CommandLine app = program.AddSubcommand("render", "Render meshes to an image");
  DeclareRenderOptions(app, *options);
  return [options, app, start]() {
    options->Coloring.Enabled = options->Coloring.Enabled || !options->Coloring.Array.empty();
    CheckRenderOptions(app, *options);
    const int status = Render(*options, start);
    if (status == Done)
    {
      std::vector<std::string> warnings = FindIgnoredOptions(app, *options);
      // `animate` gives these options another meaning, so FindIgnoredOptions() does not check them.
      if (app.Count("--frames") > 0 && options->Engine == "ray")
      {
        warnings.emplace_back("--frames has no effect with --engine ray");
      }
      if (app.Count("--jobs") > 0 && !(HasName(options->Output) && options->Files.size() > 1))
      {
        warnings.emplace_back("--jobs has no effect without several files and {name} in --output");
      }
      for (const std::string& warning : warnings)
      {
        PrintMessage("warning: " + warning);
      }
    }
    return status;
  };
}

}
