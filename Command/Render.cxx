// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// penumbra render: meshes to pictures.
#include "Engine.h"
#include "Failure.h"
#include "MessageLog.h"
#include "PendingFile.h"
#include "Pictures.h"
#include "ProgressLine.h"
#include "RenderOptions.h"
#include "Report.h"
#include "SceneBuilder.h"
#include "Subcommands.h"
#include "Surfaces.h"
#include "Worker.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkSMPTools.h"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>

namespace penumbra
{

namespace
{

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string ReplaceName(const std::string& pattern, const std::string& file)
{
  const std::string name = std::filesystem::path(file).stem().string();
  std::string path = pattern;
  for (std::size_t at = 0; (at = path.find("{name}", at)) != std::string::npos; at += name.size())
  {
    path.replace(at, 6, name);
  }
  return path;
}

bool HasName(const std::string& pattern)
{
  return pattern.find("{name}") != std::string::npos;
}

// Every pixel has the colour of the background, or none at all.
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

// Why a picture shows nothing; empty where it shows something.
std::string ExplainEmptiness(
  const Picture& picture, vtkRenderer* renderer, const RenderOptions& options)
{
  const bool empty = picture.Coverage == Picture::Coverages::Empty;
  if (!empty && !ShowsOnlyBackground(picture.Image, renderer, options.Background))
  {
    return std::string();
  }
  if (options.Opacity == 0.0)
  {
    return "everything is transparent: the picture shows only the background; raise --opacity";
  }
  if (empty)
  {
    return "nothing in view; check the --camera options";
  }
  return picture.Coverage == Picture::Coverages::Unknown
    ? "nothing to see: the picture shows only the background; check the --camera options, the "
      "colours and the lights"
    : "what is in view cannot be told from the background; check the colours and the lights";
}

std::vector<vtkSmartPointer<vtkPolyData>> ReadMeshes(
  const std::vector<std::string>& files, ProgressLine& progress, std::vector<std::string>& warnings)
{
  std::vector<vtkSmartPointer<vtkPolyData>> meshes;
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    progress.Show("reading", static_cast<double>(i) / files.size());
    EnterPhase(files[i], BadInput);
    const Surfaces surfaces = ReadSurfaces(files[i]);
    meshes.insert(meshes.end(), surfaces.Meshes.begin(), surfaces.Meshes.end());
    if (surfaces.DroppedPoints > 0)
    {
      warnings.push_back(files[i] + ": " + std::to_string(surfaces.DroppedPoints) + " of " +
        std::to_string(surfaces.Points) +
        " points are not finite: left out, with the cells around them");
    }
  }
  return meshes;
}

// One picture, in its own process.
int RenderPicture(const RenderOptions& options, Clock::time_point start)
{
  PendingFile output(options.Output, "--output");
  std::optional<PendingFile> statistics;
  if (!options.Statistics.empty())
  {
    statistics.emplace(options.Statistics, "--statistics");
  }
  const bool rays = options.Engine == "ray";
  if (!rays)
  {
    ChooseWindow(options.Window);
  }
  if (options.Threads > 0)
  {
    vtkSMPTools::Initialize(options.Threads);
  }

  ProgressLine progress(options.Progress);
  std::vector<std::string> warnings;
  Clock::time_point lap = Clock::now();
  const auto meshes = ReadMeshes(options.Files, progress, warnings);
  const double readSeconds = SecondsSince(lap);

  EnterPhase("drawing " + options.Output, MachineCannot);
  lap = Clock::now();
  const vtkSmartPointer<vtkRenderer> renderer =
    BuildScene(meshes, options, rays ? 1.0 : options.DotsPerInch / 72.0);
  const double sceneSeconds = SecondsSince(lap);
  const auto listener = [&progress](double share) { progress.Show("drawing", share); };
  const Picture picture = rays ? RenderWithRays(renderer, options, listener)
                               : RenderWithRaster(renderer, options, listener);
  warnings.insert(warnings.end(), picture.Warnings.begin(), picture.Warnings.end());
  const std::string emptiness = ExplainEmptiness(picture, renderer, options);
  if (!emptiness.empty())
  {
    warnings.push_back(emptiness);
  }

  EnterPhase("writing " + options.Output, MachineCannot);
  progress.Show("writing", 1.0);
  lap = Clock::now();
  WritePicture(picture.Image, output, options.Output, !options.Background, options.DotsPerInch);
  const double writeSeconds = SecondsSince(lap);
  if (statistics)
  {
    const nlohmann::json report = { { "statistics", picture.Statistics },
      { "estimated_error", picture.EstimatedError }, { "tolerance", options.Tolerance },
      { "threads", picture.Threads },
      { "seconds",
        { { "read", readSeconds }, { "build", sceneSeconds + picture.BuildSeconds },
          { "render", picture.RenderSeconds }, { "write", writeSeconds },
          { "total", SecondsSince(start) } } },
      { "peak_memory_bytes", PeakMemory() } };
    statistics->Write(report.dump(2) + "\n");
    statistics->Commit();
  }
  output.Commit();
  progress.Clear();
  SayWarnings(warnings);
  return Done;
}

// Nothing that is read or written may be written over.
void CheckFiles(const RenderOptions& picture, const std::vector<std::string>& inputs)
{
  RefuseInput(picture.Output, "--output", inputs);
  if (picture.Statistics.empty())
  {
    return;
  }
  RefuseInput(picture.Statistics, "--statistics", inputs);
  std::error_code ignored;
  if (std::filesystem::weakly_canonical(picture.Statistics, ignored) ==
    std::filesystem::weakly_canonical(picture.Output, ignored))
  {
    throw Failure(
      BadInput, "--statistics " + picture.Statistics + ": this is the --output; name another file");
  }
}

// One picture of all files, or one of each where the output's name holds {name}.
std::vector<RenderOptions> PlanPictures(const RenderOptions& options)
{
  if (!HasName(options.Output))
  {
    if (HasName(options.Statistics))
    {
      throw Failure(BadInput, "--statistics: {name} is only for an --output with {name}");
    }
    return { options };
  }
  if (options.Files.size() > 1 && !options.Statistics.empty() && !HasName(options.Statistics))
  {
    throw Failure(
      BadInput, "--statistics " + options.Statistics + ": several pictures need {name} in it");
  }
  std::vector<RenderOptions> pictures;
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
      throw Failure(BadInput,
        file + ": another file would give the same picture " + one.Output + "; rename one");
    }
    pictures.push_back(one);
  }
  return pictures;
}

int Render(const RenderOptions& options, Clock::time_point start)
{
  std::vector<RenderOptions> pictures = PlanPictures(options);
  for (const RenderOptions& picture : pictures)
  {
    CheckFiles(picture, options.Files);
  }
  const int count = static_cast<int>(pictures.size());
  const int jobs = std::min(options.Jobs, count);
  if (jobs > 1 && options.Threads == 0)
  {
    const int threads = std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads() / jobs);
    for (RenderOptions& picture : pictures)
    {
      picture.Threads = threads;
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
      progress->Show(std::to_string(done) + " of " + std::to_string(count) + " pictures",
        static_cast<double>(done) / count);
    }
  };
  return RunWorkers(
    count, jobs, [&](int i) { return RenderPicture(pictures[i], start); }, finished);
}

}

Action DeclareRender(CLI::App& program)
{
  const Clock::time_point start = Clock::now();
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* app = program.add_subcommand("render", "Draw meshes into a picture");
  DeclareRenderOptions(*app, *options);
  return [options, app, start]() {
    options->Coloring.Enabled = options->Coloring.Enabled || !options->Coloring.Array.empty();
    CheckRenderOptions(*app, *options);
    const int status = Render(*options, start);
    if (status == Done)
    {
      for (const std::string& warning : FindIdleOptions(*app, *options))
      {
        Say("warning: " + warning);
      }
    }
    return status;
  };
}

}
