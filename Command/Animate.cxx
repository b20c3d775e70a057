// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// penumbra animate: renders an orbit, moving parts or a time series to numbered images.
//
// A separate process renders each group of successive frames, and a frame may reuse results of the frame
// before it in the group. The groups do not depend on --jobs. A group with missing images is rendered
// again from its first frame. The images therefore do not depend on --jobs or on interruptions.
#include "Engines/Engine.h"
#include "Engines/RenderOutput.h"
#include "Files/Placeholders.h"
#include "Files/Report.h"
#include "Film/Film.h"
#include "Options/FrozenOptions.h"
#include "Processes/CommandConstants.h"
#include "Processes/CommandError.h"
#include "Processes/MessageLog.h"
#include "Processes/ProgressLine.h"
#include "Processes/Worker.h"
#include "Scene/SceneBuilder.h"
#include "Subcommands.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <memory>
#include <optional>

namespace penumbra
{

namespace
{

/// A scene and the number of actors of each file.
struct AnimatedScene
{
  vtkSmartPointer<vtkRenderer> Renderer;
  std::vector<int> Actors;
};

AnimatedScene ReadScene(const RenderOptions& options, const StepInput& input, bool allowEmpty,
  std::vector<std::string>& warnings)
{
  ProgressLine silent("none");
  AnimatedScene scene;
  Surfaces surfaces;
  for (const std::string& file : input.Files)
  {
    const Surfaces more =
      ReadMeshes({ file }, GetInputOptions(options, input.Time, allowEmpty), silent, warnings);
    surfaces.Append(more);
    scene.Actors.push_back(static_cast<int>(more.Meshes.size()));
  }
  EnterPhase("rendering " + options.Output, Unavailable);
  try
  {
    scene.Renderer =
      BuildScene(surfaces, options, options.Engine == "ray" ? 1.0 : options.DotsPerInch / 72.0);
  }
  catch (const CommandError& error)
  {
    // An array that only this step lacks.
    throw CommandError(error.ExitStatus, options.Output + ": " + error.what());
  }
  return scene;
}

/// Moves the actors and the camera to a frame. `fixed` has the camera of the first frame.
void Move(const AnimatedScene& scene, const Film& film, const RenderOptions& fixed, int frame)
{
  const double time = film.ComputeFraction(frame);
  vtkActorCollection* actors = scene.Renderer->GetActors();
  for (const Movement& movement : film.GetOptions().Movements)
  {
    int first = 0;
    for (int file = 0; file < movement.File; ++file)
    {
      first += scene.Actors[file];
    }
    for (int i = first; i < first + scene.Actors[movement.File]; ++i)
    {
      vtkActor* actor = vtkActor::SafeDownCast(actors->GetItemAsObject(i));
      actor->SetPosition(time * movement.Displacement[0], time * movement.Displacement[1],
        time * movement.Displacement[2]);
    }
  }
  RenderOptions turned = fixed;
  turned.Camera.Azimuth = time * film.GetOptions().Orbit;
  PlaceCamera(scene.Renderer, turned);
}

/// Consecutive frames that one process renders.
struct FrameGroup
{
  int First = 0;
  int Last = 0; ///< the last frame to render; later ones are not wanted or up to date
};

bool IsMissing(const Film& film, int frame)
{
  return film.IsWanted(frame) && !film.IsUpToDate(frame);
}

/// Calls action(), which writes the image `output`. Returns whether it succeeded; else prints the error and raises
/// `status` to its exit status.
template <typename Attempt>
bool Succeeds(const Attempt& action, const std::string& output, int& status)
{
  try
  {
    action();
    return true;
  }
  catch (const CommandError& error)
  {
    PrintError(error.what(), ReplaceAll(error.what(), output, ""));
    status = std::max<int>(status, error.ExitStatus);
    return false;
  }
}

/// Renders the missing frames of a group in order, also if the files of some cannot be written.
int RenderGroup(const Film& film, const FrameGroup& group, int threads)
{
  RenderOptions fixed = film.GetFrameOptions(group.First);
  fixed.Threads = threads;
  const bool rays = fixed.Engine == "ray";
  ChooseWindowFor(fixed);
  if (threads > 0)
  {
    vtkSMPTools::Initialize(threads);
  }
  PhaseTimes preparation{ Clock::now() };
  std::vector<std::string> warnings;
  const AnimatedScene scene =
    ReadScene(fixed, film.GetInput(group.First), film.IsSeries(), warnings);
  if (!film.HasDefaults())
  {
    FreezeOptions(scene.Renderer, ComputeBounds(scene.Renderer, fixed).GetDiagonalLength(), fixed);
  }
  preparation.ReadSeconds = SecondsSince(preparation.Start);
  std::function<RenderResult(const ProgressListener&)> draw;
  // Light shafts depend on the bounds, which moving parts change.
  const bool isOrbit =
    film.GetOptions().Movements.empty() && !film.IsSeries() && film.GetNumberOfFrames() > 1;
  if (!rays || isOrbit)
  {
    draw = rays ? PrepareRays(scene.Renderer, fixed) : PrepareRaster(scene.Renderer, fixed);
  }
  int status = Done;
  for (int frame = group.First; frame <= group.Last; ++frame)
  {
    const RenderOptions one = film.GetFrameOptions(frame);
    fixed.Output = one.Output;
    fixed.Statistics = one.Statistics;
    const bool missing = IsMissing(film, frame);
    if (!missing && rays)
    {
      continue;
    }
    Move(scene, film, fixed, frame);
    std::optional<OutputFiles> output;
    const auto open = [&] {
      CreateFolders(fixed);
      output.emplace(fixed);
    };
    const bool writable = missing && Succeeds(open, fixed.Output, status);
    if (!writable && rays)
    {
      continue;
    }
    EnterPhase("rendering " + fixed.Output, Unavailable);
    const ProgressListener silent = [](double) {};
    const RenderResult result = draw ? draw(silent) : RenderWithRays(scene.Renderer, fixed, silent);
    const auto save = [&] {
      for (const std::string& warning :
        output->Save(result, scene.Renderer, fixed, preparation, film.GetFingerprint(frame)))
      {
        warnings.push_back(fixed.Output + ": " + warning);
      }
    };
    if (writable)
    {
      Succeeds(save, fixed.Output, status);
    }
    preparation = { Clock::now() };
  }
  PrintWarnings(warnings);
  return status;
}

/// Returns the groups that have missing images, and the number of these in `missing`.
std::vector<FrameGroup> FindGroups(const Film& film, int& missing)
{
  const int size = film.IsSeries() ? 1 : FramesPerGroup;
  std::vector<FrameGroup> groups;
  missing = 0;
  for (int frame = 0; frame < film.GetNumberOfFrames(); ++frame)
  {
    CheckFiles(film.GetFrameOptions(frame));
    if (!IsMissing(film, frame))
    {
      continue;
    }
    const int first = frame - frame % size;
    if (groups.empty() || groups.back().First != first)
    {
      groups.push_back({ first, frame });
    }
    groups.back().Last = frame;
    ++missing;
  }
  return groups;
}

int Animate(const FilmOptions& options)
{
  RecordInputs(options.Render);
  Film film(options);
  if (film.GetStatus() != Done)
  {
    return film.GetStatus();
  }
  const ColoringOptions& coloring = options.Render.Coloring;
  const bool needsDefaults =
    film.IsSeries() || !options.Prepare.empty() || (coloring.Enabled && coloring.RangeOfAllSteps);
  int missing = 0;
  std::vector<FrameGroup> groups = FindGroups(film, missing);
  if (needsDefaults && !film.HasDefaults() && (!groups.empty() || !options.Prepare.empty()))
  {
    const int status = film.FindDefaults();
    if (status != Done)
    {
      return status;
    }
  }
  if (!options.Prepare.empty())
  {
    film.WriteDefaults();
    return Done;
  }
  int wanted = 0;
  for (int frame = 0; frame < film.GetNumberOfFrames(); ++frame)
  {
    wanted += film.IsWanted(frame) ? 1 : 0;
  }
  const int count = static_cast<int>(groups.size());
  const int jobs = std::max(1, std::min(options.Render.Jobs, count));
  int threads = options.Render.Threads;
  if (jobs > 1 && threads == 0)
  {
    threads = std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads() / jobs);
  }
  ProgressLine progress(options.Render.Progress);
  const auto finished = [&](int done) {
    const int made = wanted - missing + missing * done / count;
    progress.Show(std::to_string(made) + " of " + std::to_string(wanted) + " images",
      static_cast<double>(made) / wanted);
  };
  return RunWorkers(
    count, jobs, [&](int i) { return RenderGroup(film, groups[i], threads); }, finished);
}

}

Action DeclareAnimate(const CommandLine& program)
{
  const auto options = std::make_shared<FilmOptions>();
  const CommandLine app =
    program.AddSubcommand("animate", "Render an orbit, moving parts or a time series");
  DeclareFilmOptions(app, *options);
  return [options, app]() {
    RenderOptions& render = options->Render;
    CompleteRenderOptions(app, render);
    render.Camera.HasZoomFactor = true; // An orbit must not leave a view that a look fits.
    CheckRenderOptions(app, render);
    CheckFilmOptions(app, *options);
    const int status = Animate(*options);
    if (status == Done)
    {
      for (const std::string& warning : FindIgnoredOptions(app, render))
      {
        PrintMessage("warning: " + warning);
      }
    }
    return status;
  };
}

}
