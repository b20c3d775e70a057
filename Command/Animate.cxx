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
#include "Files/ImageFiles.h"
#include "Files/Report.h"
#include "Options/FrozenOptions.h"
#include "Options/RenderOptions.h"
#include "Processes/CommandConstants.h"
#include "Processes/CommandError.h"
#include "Processes/MessageLog.h"
#include "Processes/ProgressLine.h"
#include "Processes/Worker.h"
#include "Scene/SceneBuilder.h"
#include "Subcommands.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkSMPTools.h"
#include "vtkVersion.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <sstream>

namespace penumbra
{

namespace
{

/// Displacement of the surfaces of one file over the animation.
struct Movement
{
  int File = 0; ///< zero-based index
  Vector3 Displacement{};
};

struct AnimationOptions
{
  RenderOptions Render;
  int Frames = 60;
  double Orbit = Unset; ///< degrees
  std::vector<Movement> Movements;
  bool TimeSeries = false;
  bool Resume = false;
  std::string Description; ///< all options that affect an image
};

constexpr const char* FramePlaceholder = "{frame}";

bool HasFrame(const std::string& pattern)
{
  return pattern.find(FramePlaceholder) != std::string::npos;
}

std::string ReplaceFrame(const std::string& pattern, int frame)
{
  std::string number = std::to_string(frame);
  number.insert(0, number.size() < 4 ? 4 - number.size() : 0, '0');
  return ReplaceAll(pattern, FramePlaceholder, number);
}

/// Computes the animation time in [0, 1] of a frame. Whole turns stop one step before 1, so that they
/// loop without a repeated frame; other motions end at 1.
double ComputeTime(const AnimationOptions& options, int frame)
{
  const bool turns = options.Movements.empty() && std::fmod(options.Orbit, 360.0) == 0.0;
  return frame / static_cast<double>(std::max(turns ? options.Frames : options.Frames - 1, 1));
}

// Computes the 64-bit Fowler-Noll-Vo hash (FNV-1a).
std::string Hash(const std::string& text)
{
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char byte : text)
  {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  }
  std::ostringstream digits;
  digits << std::hex << hash;
  return digits.str();
}

/// Identifies an image by its input files, options, program version and frame number.
std::string Fingerprint(const AnimationOptions& options, int frame)
{
  std::ostringstream text;
  text << PENUMBRA_VERSION << ' ' << vtkVersion::GetVTKVersion() << ' ' << frame << '\n'
       << options.Description;
  for (const std::string& file : options.Render.Files)
  {
    std::error_code ignored;
    text << file << ' ' << std::filesystem::file_size(file, ignored) << ' '
         << std::filesystem::last_write_time(file, ignored).time_since_epoch().count() << '\n';
  }
  return "animate " + Hash(text.str());
}

/// Returns the render options of one frame.
RenderOptions GetFrameOptions(const AnimationOptions& options, int frame)
{
  RenderOptions one = options.Render;
  one.Output = ReplaceFrame(options.Render.Output, frame);
  one.Statistics = ReplaceFrame(options.Render.Statistics, frame);
  return one;
}

bool IsUpToDate(const AnimationOptions& options, int frame)
{
  const RenderOptions one = GetFrameOptions(options, frame);
  return options.Resume && ReadNote(one.Output) == Fingerprint(options, frame) &&
    (one.Statistics.empty() || std::filesystem::exists(one.Statistics));
}

/// A scene and the number of actors of each file.
struct AnimatedScene
{
  vtkSmartPointer<vtkRenderer> Renderer;
  std::vector<int> Actors;
};

AnimatedScene ReadScene(const RenderOptions& options, const std::vector<std::string>& files,
  std::vector<std::string>& warnings)
{
  ProgressLine silent("none");
  AnimatedScene scene;
  std::vector<vtkSmartPointer<vtkPolyData>> meshes;
  for (const std::string& file : files)
  {
    const auto more = ReadMeshes({ file }, silent, warnings);
    meshes.insert(meshes.end(), more.begin(), more.end());
    scene.Actors.push_back(static_cast<int>(more.size()));
  }
  EnterPhase("rendering " + options.Output, Unavailable);
  scene.Renderer =
    BuildScene(meshes, options, options.Engine == "ray" ? 1.0 : options.DotsPerInch / 72.0);
  return scene;
}

/// Moves the actors and the camera to a frame. `fixed` has the camera of the first frame.
void Move(const AnimatedScene& scene, const AnimationOptions& options, const RenderOptions& fixed,
  int frame)
{
  const double time = ComputeTime(options, frame);
  vtkActorCollection* actors = scene.Renderer->GetActors();
  for (const Movement& movement : options.Movements)
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
  turned.Camera.Azimuth = time * options.Orbit;
  PlaceCamera(scene.Renderer, turned);
}

/// Renders the frames [first, last) in order.
int RenderGroup(const AnimationOptions& options, int first, int last)
{
  const RenderOptions& all = options.Render;
  const bool rays = all.Engine == "ray";
  ChooseWindowFor(all);
  if (all.Threads > 0)
  {
    vtkSMPTools::Initialize(all.Threads);
  }
  const std::vector<std::string> files =
    options.TimeSeries ? std::vector<std::string>{ all.Files.front() } : all.Files;
  PhaseTimes preparation{ Clock::now() };
  std::vector<std::string> warnings;
  AnimatedScene scene = ReadScene(all, files, warnings);
  RenderOptions fixed = all;
  FreezeOptions(scene.Renderer, ComputeBounds(scene.Renderer, all).GetDiagonalLength(), fixed);
  if (options.TimeSeries && first > 0)
  {
    warnings.clear();
    scene = ReadScene(fixed, { all.Files[first] }, warnings);
  }
  preparation.ReadSeconds = SecondsSince(preparation.Start);
  std::function<RenderResult(const ProgressListener&)> draw;
  // Light shafts depend on the bounds, which moving parts change.
  const bool isOrbit = options.Movements.empty() && !options.TimeSeries && options.Frames > 1;
  if (!rays || isOrbit)
  {
    draw = rays ? PrepareRays(scene.Renderer, fixed) : PrepareRaster(scene.Renderer, fixed);
  }
  for (int frame = first; frame < last; ++frame)
  {
    RenderOptions one = GetFrameOptions(options, frame);
    fixed.Output = one.Output;
    fixed.Statistics = one.Statistics;
    Move(scene, options, fixed, frame);
    const bool made = IsUpToDate(options, frame);
    if (made && rays)
    {
      continue;
    }
    OutputFiles output(fixed);
    EnterPhase("rendering " + fixed.Output, Unavailable);
    const ProgressListener silent = [](double) {};
    const RenderResult result = draw ? draw(silent) : RenderWithRays(scene.Renderer, fixed, silent);
    if (!made)
    {
      for (const std::string& warning :
        output.Save(result, scene.Renderer, fixed, preparation, Fingerprint(options, frame)))
      {
        warnings.push_back(fixed.Output + ": " + warning);
      }
    }
    preparation = { Clock::now() };
  }
  PrintWarnings(warnings);
  return Done;
}

/// Renders the groups that have missing images.
int Animate(AnimationOptions& options)
{
  RenderOptions& all = options.Render;
  const int size = options.TimeSeries ? 1 : FramesPerGroup;
  RecordInputs(all);
  std::vector<int> firsts;
  int missing = 0;
  for (int first = 0; first < options.Frames; first += size)
  {
    const int before = missing;
    for (int frame = first; frame < std::min(first + size, options.Frames); ++frame)
    {
      CheckFiles(GetFrameOptions(options, frame));
      missing += IsUpToDate(options, frame) ? 0 : 1;
    }
    if (missing > before)
    {
      firsts.push_back(first);
    }
  }
  const int count = static_cast<int>(firsts.size());
  const int jobs = std::max(1, std::min(all.Jobs, count));
  if (jobs > 1 && all.Threads == 0)
  {
    all.Threads = std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads() / jobs);
  }
  ProgressLine progress(all.Progress);
  const auto finished = [&](int done) {
    const int made = options.Frames - missing + std::min(done * size, missing);
    progress.Show(std::to_string(made) + " of " + std::to_string(options.Frames) + " images",
      static_cast<double>(made) / options.Frames);
  };
  return RunWorkers(
    count, jobs,
    [&](int i) {
      return RenderGroup(options, firsts[i], std::min(firsts[i] + size, options.Frames));
    },
    finished);
}

void DeclareMotion(const CommandLine& app, AnimationOptions& options)
{
  const std::string group = "Motion";
  AddInteger(app, "--frames", options.Frames, "Number of images; for a time series, one per file",
    1, 1000000)
    .Group(group);
  AddNumber(app, "--orbit", options.Orbit, "DEG",
    "Rotate the camera around the focal point to the right; default: 360 if nothing else moves",
    { -1e6, 1e6 })
    .Default("")
    .Group(group);
  const auto storeMovements = [&options](const std::vector<std::string>& texts) {
    for (const std::string& text : texts)
    {
      const std::size_t colon = text.find(':');
      if (colon == std::string::npos)
      {
        throw InvalidValue("--move", "'" + text + "' is not of the form N:X,Y,Z");
      }
      const double file = ParseNumbers("--move", text.substr(0, colon), 1, 1, { 1.0, 1e6 })[0];
      const std::vector<double> displacement =
        ParseNumbers("--move", text.substr(colon + 1), 3, 3, { -1e100, 1e100 });
      options.Movements.push_back(
        { static_cast<int>(file) - 1, { displacement[0], displacement[1], displacement[2] } });
    }
  };
  app
    .AddRepeatable("--move", storeMovements,
      "Move file number N (1: the first) by X,Y,Z in world units over the animation; repeatable")
    .TypeName("N:X,Y,Z")
    .Group(group);
  app
    .AddFlag("--time-series", options.TimeSeries,
      "Each file is one time step; camera and colors are those of the first")
    .Group(group);
  app
    .AddFlag("--resume", options.Resume,
      "Keep existing images that were made from the same files with the same options (.png)")
    .Group("Output");
}

void CheckMotion(const CommandLine& app, AnimationOptions& options)
{
  const RenderOptions& render = options.Render;
  if (!HasFrame(render.Output))
  {
    throw CommandError(
      BadInput, "--output " + render.Output + ": the path of numbered images must contain {frame}");
  }
  if (!render.Statistics.empty() && !HasFrame(render.Statistics))
  {
    throw CommandError(BadInput,
      "--statistics " + render.Statistics + ": the path must contain {frame}, one file per image");
  }
  if (options.Resume && std::filesystem::path(render.Output).extension() != ".png")
  {
    throw CommandError(BadInput,
      "--resume requires an --output that ends in .png, the format that stores the options");
  }
  for (const Movement& movement : options.Movements)
  {
    if (movement.File >= static_cast<int>(render.Files.size()))
    {
      throw CommandError(BadInput,
        "--move " + std::to_string(movement.File + 1) + ": the number must be at most " +
          std::to_string(render.Files.size()) + ", the number of files");
    }
  }
  if (options.TimeSeries)
  {
    if (app.Count("--frames") > 0 || !options.Movements.empty())
    {
      throw CommandError(BadInput,
        "--time-series renders one image per file; it cannot be combined with --frames or --move");
    }
    options.Frames = static_cast<int>(render.Files.size());
  }
  if (std::isnan(options.Orbit))
  {
    options.Orbit = options.TimeSeries || !options.Movements.empty() ? 0.0 : 360.0;
  }
}

/// Returns all options as text, except paths and the options that do not affect an image.
std::string Describe(const CommandLine& app)
{
  const std::vector<std::string> others = { "output", "resume", "jobs", "threads", "progress",
    "read-limit", "statistics", "FILE" };
  std::istringstream lines(app.Describe());
  std::string description;
  for (std::string line; std::getline(lines, line);)
  {
    const std::string name = line.substr(0, line.find('='));
    if (std::find(others.begin(), others.end(), name) == others.end())
    {
      description += line + '\n';
    }
  }
  return description;
}

}

Action DeclareAnimate(const CommandLine& program)
{
  const auto options = std::make_shared<AnimationOptions>();
  const CommandLine app =
    program.AddSubcommand("animate", "Render an orbit, moving parts or a time series");
  DeclareRenderOptions(app, options->Render);
  app.Remove("--frames"); // The option of `render` has another meaning.
  DeclareMotion(app, *options);
  app.Get("--output")
    .Description("Images: .png .jpg .tif .bmp (8 bits per channel) or .vti; {frame} is replaced "
                 "by the frame number");
  app.Get("--statistics")
    .Description(
      "Write ray counts, estimated error, times and memory to these files; {frame} as in --output");
  app.Get("--jobs").Description("Number of groups of images rendered at the same time");
  return [options, app]() {
    RenderOptions& render = options->Render;
    render.Coloring.Enabled = render.Coloring.Enabled || !render.Coloring.Array.empty();
    CheckRenderOptions(app, render);
    CheckMotion(app, *options);
    options->Description = Describe(app);
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
