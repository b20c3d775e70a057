// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// penumbra render: renders meshes to images.
#include "Engines/Engine.h"
#include "Engines/RenderOutput.h"
#include "Files/Placeholders.h"
#include "Files/Report.h"
#include "Files/StandardStreams.h"
#include "Film/StepInput.h"
#include "Options/RenderOptions.h"
#include "Processes/CommandConstants.h"
#include "Processes/CommandError.h"
#include "Processes/MessageLog.h"
#include "Processes/ProgressLine.h"
#include "Processes/Worker.h"
#include "Scene/SceneBuilder.h"
#include "Subcommands.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkLight.h"
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
    [&](const std::string& placeholder) { return Contains(pattern, placeholder); });
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
  const Surfaces surfaces =
    ReadMeshes(options.Files, GetInputOptions(options, options.ShownTime), progress, warnings);
  preparation.ReadSeconds = SecondsSince(lap);

  EnterPhase("rendering " + options.Output, Unavailable);
  lap = Clock::now();
  const vtkSmartPointer<vtkRenderer> renderer =
    BuildScene(surfaces, options, rays ? 1.0 : options.DotsPerInch / 72.0);
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

// Returns the options of each scene: one of all files, or one per file if the output path contains {name}.
std::vector<RenderOptions> PlanScenes(const RenderOptions& options)
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
  std::vector<RenderOptions> scenes;
  std::set<std::string> outputs;
  for (const std::string& file : options.Files)
  {
    RenderOptions one = options;
    one.Files = { file };
    one.Output = ReplaceName(options.Output, file);
    one.Statistics = ReplaceName(options.Statistics, file);
    if (!outputs.insert(one.Output).second)
    {
      throw CommandError(BadInput,
        file + ": another file has the same output " + one.Output + "; rename one of the two");
    }
    scenes.push_back(one);
  }
  return scenes;
}

// Returns whether images depend on the times of the files.
bool UsesTime(const RenderOptions& options)
{
  return options.Time.IsSet() || options.TimeLabel ||
    (options.Coloring.Enabled && options.Coloring.RangeOfAllSteps) ||
    Contains(options.Text, TimePlaceholder) || Contains(options.Output, TimePlaceholder) ||
    Contains(options.Statistics, TimePlaceholder);
}

// Returns the images of a scene: one, or one per time of --times.
std::vector<RenderOptions> PlanTimes(const RenderOptions& scene, const Timeline& timeline)
{
  const std::string name = scene.Files.size() == 1 ? scene.Files.front() : "the set of files";
  std::vector<double> times = SelectTimes(scene.Time, timeline, name);
  if (!scene.Time.IsSet() && times.size() > 1)
  {
    times.resize(1);
  }
  if (times.size() > 1 && !Contains(scene.Output, TimePlaceholder))
  {
    throw CommandError(BadInput, "--times requires an --output that contains {time}");
  }
  if (times.size() > 1 && !scene.Statistics.empty() && !Contains(scene.Statistics, TimePlaceholder))
  {
    throw CommandError(BadInput,
      "--statistics " + scene.Statistics + ": the path must contain {time}, one file per image");
  }
  const bool usesRangeOnly = !Contains(scene.Output, TimePlaceholder) &&
    !Contains(scene.Statistics, TimePlaceholder) && !Contains(scene.Text, TimePlaceholder) &&
    !scene.TimeLabel;
  if (times.empty() && !usesRangeOnly)
  {
    throw CommandError(BadInput, "--time-label or {time}: " + name + " has no time steps");
  }
  const std::vector<std::string> texts = FormatTimes(times);
  std::vector<RenderOptions> images;
  for (std::size_t i = 0; i < times.size(); ++i)
  {
    RenderOptions one = scene;
    one.ShownTime = times[i];
    one.TimeText = texts[i];
    one.Output = ReplaceAll(one.Output, TimePlaceholder, texts[i]);
    one.Statistics = ReplaceAll(one.Statistics, TimePlaceholder, texts[i]);
    images.push_back(one);
  }
  return images.empty() ? std::vector<RenderOptions>{ scene } : images;
}

// Replaces scenes by their images; none has any if the times of one cannot be read, and those with a step that
// cannot be read have none. Returns the largest exit status.
int PlanImages(std::vector<RenderOptions>& images)
{
  std::vector<std::vector<std::string>> files;
  for (const RenderOptions& image : images)
  {
    files.push_back(image.Files);
  }
  std::vector<Timeline> timelines;
  int status = ReadTimelines(files, images.front().Jobs, timelines);
  const bool hasTimelines = status == Done;
  std::vector<RenderOptions> scenes;
  scenes.swap(images);
  for (std::size_t i = 0; i < scenes.size() && hasTimelines; ++i)
  {
    std::vector<StepInput> steps;
    for (const double time : timelines[i].Times)
    {
      steps.push_back({ scenes[i].Files, time });
    }
    if (scenes[i].Coloring.Enabled && scenes[i].Coloring.RangeOfAllSteps && steps.size() > 1)
    {
      const int found = SetRangeOfAllSteps(steps, scenes[i]);
      status = std::max(status, found);
      if (found != Done)
      {
        continue;
      }
    }
    for (const RenderOptions& image : PlanTimes(scenes[i], timelines[i]))
    {
      images.push_back(image);
    }
  }
  return status;
}

int Render(const RenderOptions& options, Clock::time_point start)
{
  std::vector<RenderOptions> images = PlanScenes(options);
  RecordInputs(options);
  const int status = UsesTime(options) ? PlanImages(images) : Done;
  const int count = static_cast<int>(images.size());
  for (RenderOptions& image : images)
  {
    CheckFiles(image);
    if (count > 1)
    {
      image.Progress = "none";
    }
  }
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
  const auto render = [&](int i) {
    if (images[i].Output != options.Output)
    {
      CreateFolders(images[i]);
    }
    return RenderImage(images[i], start);
  };
  const int rendered = RunWorkers(count, jobs, render, finished);
  return std::max(status, rendered);
}

}

Action DeclareRender(const CommandLine& program)
{
  const Clock::time_point start = Clock::now();
  const auto options = std::make_shared<RenderOptions>();
  const CommandLine app = program.AddSubcommand("render", "Render meshes to an image");
  DeclareRenderOptions(app, *options);
  return [options, app, start]() {
    StreamFolder streams;
    if (options->Output == StandardStream)
    {
      options->Output = streams.PrepareOutput();
    }
    CompleteRenderOptions(app, *options);
    CheckRenderOptions(app, *options);
    if (std::count(options->Files.begin(), options->Files.end(), StandardStream) > 0)
    {
      const std::string input = streams.ReadInput();
      std::replace(
        options->Files.begin(), options->Files.end(), std::string(StandardStream), input);
    }
    const int status = Render(*options, start);
    if (status == Done)
    {
      streams.WriteOutput();
      std::vector<std::string> warnings = FindIgnoredOptions(app, *options);
      // `animate` gives these options another meaning, so FindIgnoredOptions() does not check them.
      if (app.Count("--frames") > 0 && options->Engine == "ray")
      {
        warnings.emplace_back("--frames has no effect with --engine ray");
      }
      if (app.Count("--jobs") > 0 && !(HasName(options->Output) && options->Files.size() > 1) &&
        !options->Time.Range)
      {
        warnings.emplace_back(
          "--jobs has no effect without several files and {name} in --output, or --times");
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
