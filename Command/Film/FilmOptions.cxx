// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FilmOptions.h"

#include "Files/Placeholders.h"
#include "Processes/CommandConstants.h"
#include "Processes/CommandError.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace penumbra
{

namespace
{

// Parses "A" or "A:B".
FrameRange ParseFrames(const std::string& option, const std::string& text)
{
  const std::size_t colon = text.find(':');
  const int first = ParseInteger(option, text.substr(0, colon), 0, MaximumFrames);
  const int last =
    colon == text.npos ? first : ParseInteger(option, text.substr(colon + 1), 0, MaximumFrames);
  if (last < first)
  {
    throw InvalidValue(option, "'" + text + "' begins after its end");
  }
  return { first, last };
}

void DeclareFrames(const CommandLine& app, FilmOptions& options)
{
  app.SetGroup("Motion");
  const auto storeFrames = [&options](const std::vector<std::string>& texts) {
    for (const std::string& text : texts)
    {
      if (text.find(':') == text.npos)
      {
        options.Frames = ParseInteger("--frames", text, 1, MaximumFrames);
      }
      else
      {
        options.Part = { ParseFrames("--frames", text) };
      }
    }
  };
  app
    .AddRepeatable("--frames", storeFrames,
      "N: number of images of the film, default: one per time step, else 60; A:B: render only the "
      "images A to B of the film; both may be given")
    .TypeName("N|A:B");
  const auto storeList = [&options](const std::string& text) {
    options.Part.clear();
    std::istringstream items(text + ",");
    for (std::string item; std::getline(items, item, ',');)
    {
      options.Part.push_back(ParseFrames("--frame-list", item));
    }
  };
  app.AddParsed("--frame-list", storeList, "Render only these images of the film")
    .TypeName("N,A:B,...");
}

void DeclareMovements(const CommandLine& app, FilmOptions& options)
{
  const auto store = [&options](const std::vector<std::string>& texts) {
    for (const std::string& text : texts)
    {
      const std::size_t colon = text.find(':');
      if (colon == std::string::npos)
      {
        throw InvalidValue("--move", "'" + text + "' is not of the form N:X,Y,Z");
      }
      const int file = ParseInteger("--move", text.substr(0, colon), 1, 1000000);
      const std::vector<double> displacement =
        ParseNumbers("--move", text.substr(colon + 1), 3, 3, { -1e100, 1e100 });
      options.Movements.push_back(
        { file - 1, { displacement[0], displacement[1], displacement[2] } });
    }
  };
  app
    .AddRepeatable("--move", store,
      "Move file number N (1: the first) by X,Y,Z in world units over the animation; repeatable")
    .TypeName("N:X,Y,Z");
}

// Returns all options as text, except paths and the options that do not affect an image.
std::string Describe(const CommandLine& app, const std::vector<Cut>& cuts)
{
  const std::vector<std::string> others = { "output", "resume", "jobs", "threads", "progress",
    "read-limit", "statistics", "FILE", "frames", "frame-list", "prepare", "defaults", "slice",
    "clip", "contour", "threshold", "config" };
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
  return description + DescribeCuts(cuts);
}

void CheckPaths(const FilmOptions& options)
{
  const RenderOptions& render = options.Render;
  const auto isNumbered = [](const std::string& path) {
    return Contains(path, FramePlaceholder) || Contains(path, TimePlaceholder);
  };
  if (!isNumbered(render.Output))
  {
    throw CommandError(BadInput,
      "--output " + render.Output + ": the path of numbered images must contain {frame} or {time}");
  }
  if (!render.Statistics.empty() && !isNumbered(render.Statistics))
  {
    throw CommandError(BadInput,
      "--statistics " + render.Statistics + ": the path must contain {frame}, one file per image");
  }
  if (options.Resume && std::filesystem::path(render.Output).extension() != ".png")
  {
    throw CommandError(BadInput,
      "--resume requires an --output that ends in .png, the format that stores the options");
  }
}

}

void DeclareFilmOptions(const CommandLine& app, FilmOptions& options)
{
  DeclareRenderOptions(app, options.Render);
  app.Remove("--frames"); // The option of `render` has another meaning.
  DeclareFrames(app, options);
  AddNumber(app, "--orbit", options.Orbit, "DEG",
    "Rotate the camera around the focal point to the right; default: 360 if nothing else moves",
    { -1e6, 1e6 })
    .Default("");
  DeclareMovements(app, options);
  app.AddFlag("--time-series", options.TimeSeries,
    "Each file is one time step; camera and colors are those of the first");
  app.SetGroup("Output");
  app.AddFlag("--resume", options.Resume,
    "Keep existing images that were made from the same files with the same options (.png)");
  app.AddText("--prepare", options.Prepare, "FILE.json",
    "Render nothing; write the defaults that depend on the data to this file, for --defaults");
  app.AddText("--defaults", options.Defaults, "FILE.json",
    "Use the defaults that the same command wrote with --prepare, so that several processes share "
    "one film");
  app.Get("--output")
    .Description(
      "Images: .png .jpg .jpeg .tif .tiff .bmp (8 bits per channel), .vti, or vector "
      "graphics: .svg .pdf (ray); {frame} is replaced by the frame number, {time} by the "
      "time of its step");
  app.Get("--statistics")
    .Description(
      "Write ray counts, estimated error, times and memory to these files; {frame} as in --output");
  app.Get("--jobs").Description("Number of groups of images rendered at the same time");
}

void CheckFilmOptions(const CommandLine& app, FilmOptions& options)
{
  const RenderOptions& render = options.Render;
  CheckPaths(options);
  for (const Movement& movement : options.Movements)
  {
    if (movement.File >= static_cast<int>(render.Files.size()))
    {
      throw CommandError(BadInput,
        "--move " + std::to_string(movement.File + 1) + ": the number must be at most " +
          std::to_string(render.Files.size()) + ", the number of files");
    }
  }
  if (options.TimeSeries && render.Files.size() == 1 && MayHaveTimeSteps(render.Files.front()))
  {
    options.TimeSeries = false; // The steps are those in the file.
  }
  if (options.TimeSeries &&
    (options.Frames > 0 || !options.Movements.empty() || render.Time.IsSet()))
  {
    throw CommandError(BadInput,
      "--time-series renders one image per file; it cannot be combined with --frames N, --move or "
      "the options of time steps");
  }
  if (app.Count("--frame-list") > 0 && app.Count("--frames") > 0 && options.Frames == 0)
  {
    throw CommandError(BadInput, "--frame-list cannot be combined with --frames A:B; give one");
  }
  if (!options.Prepare.empty() && !options.Defaults.empty())
  {
    throw CommandError(BadInput, "--prepare cannot be combined with --defaults; give one");
  }
  options.Description = Describe(app, render.Cuts);
}

}
