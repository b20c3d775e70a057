// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The defaults of a film that depend on its data: --coloring-range all, --prepare and --defaults.
#include "Files/AtomicFile.h"
#include "Files/JsonObject.h"
#include "Film.h"
#include "Options/FrozenOptions.h"
#include "Processes/CommandError.h"
#include "Processes/MessageLog.h"
#include "Processes/Worker.h"
#include "Processes/WorkerTexts.h"
#include "Scene/SceneBuilder.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

namespace penumbra
{

namespace
{

// Before errors of frames that cannot be read, and that lack what an option names.
constexpr char Unreadable = '!';
constexpr char Lacking = '?';

// Returns the defaults derived from one frame; empty if it shows nothing; or an error.
std::string FindFrameDefaults(const StepInput& input, RenderOptions options)
{
  try
  {
    return DescribeStep(input, options, [&options](vtkRenderer* renderer) {
      FreezeOptions(renderer, ComputeBounds(renderer, options).GetDiagonalLength(), options);
      return FormatJsonObject(DescribeFrozen(options));
    });
  }
  catch (const IncompleteStep& error)
  {
    return Lacking + std::string(error.what());
  }
  catch (const CommandError& error)
  {
    return Unreadable + std::string(error.what());
  }
}

std::vector<std::string> SplitLines(const std::string& text)
{
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
  {
    lines.push_back(line);
  }
  return lines;
}

// Returns the name of the first option that differs; empty if none does.
std::string FindDifference(const std::vector<std::string>& a, const std::vector<std::string>& b)
{
  for (const auto& [one, other] : { std::make_pair(&a, &b), std::make_pair(&b, &a) })
  {
    for (const std::string& line : *one)
    {
      if (std::find(other->begin(), other->end(), line) == other->end())
      {
        return "--" + line.substr(0, line.find('='));
      }
    }
  }
  return std::string();
}

}

std::vector<StepInput> Film::GetAllSteps() const
{
  std::vector<StepInput> steps;
  for (int frame = 0; frame < (this->Options.TimeSeries ? this->Options.Frames : 0); ++frame)
  {
    steps.push_back(this->GetInput(frame));
  }
  for (const double time : this->AllTimes)
  {
    steps.push_back({ this->Options.Render.Files, time });
  }
  return steps.empty() ? std::vector<StepInput>{ this->GetInput(0) } : steps;
}

int Film::FindDefaults()
{
  RenderOptions& render = this->Options.Render;
  if (render.Coloring.RangeOfAllSteps && render.Coloring.Enabled)
  {
    const int status = SetRangeOfAllSteps(this->GetAllSteps(), render);
    if (status != Done)
    {
      return status;
    }
  }
  std::string failure;
  int worst = Done;
  for (int frame = 0; frame < this->Options.Frames; ++frame)
  {
    const auto find = [&](int) {
      return FindFrameDefaults(this->GetInput(frame), this->GetFrameOptions(frame));
    };
    std::vector<std::string> texts;
    const int status = RunForTexts(1, 1, find, texts);
    if (status == Unavailable)
    {
      return status;
    }
    const std::string& text = texts.front();
    const char kind = text.empty() ? '\0' : text[0];
    if (!text.empty() && kind != Unreadable && kind != Lacking)
    {
      this->Defaults = ParseJsonObject(text);
      return Done;
    }
    worst = std::max(worst, status);
    const bool reported = this->Options.Prepare.empty() && this->IsWanted(frame); // by the image
    if (status != Done && !reported)
    {
      return status; // The reader crashed.
    }
    failure = failure.empty() && !text.empty() ? text.substr(1) : failure;
    if (!this->IsSeries() || (kind == Unreadable && !reported))
    {
      break;
    }
  }
  if (failure.empty() && worst != Done)
  {
    return worst; // Readers crashed.
  }
  throw CommandError(BadInput, failure.empty() ? "all time steps are empty" : failure);
}

void Film::WriteDefaults() const
{
  JsonObject film = this->Defaults;
  film["program"] = "penumbra animate";
  film["options"] = SplitLines(this->Options.Description);
  film["images"] = static_cast<double>(this->Options.Frames);
  film["times"] = this->Times;
  if (this->FixedTime)
  {
    film["time"] = *this->FixedTime;
  }
  AtomicFile file(this->Options.Prepare, "--prepare");
  file.Write(FormatJsonObject(film));
  file.Commit();
}

void Film::ReadDefaults()
{
  const std::string& path = this->Options.Defaults;
  const std::string name = "--defaults " + path + ": ";
  const int given = this->Options.Frames;
  try
  {
    std::ifstream file(path, std::ios::binary);
    if (!file)
    {
      throw CommandError(BadInput, name + "no such file; write it with --prepare");
    }
    const JsonObject film = ParseJsonObject({ std::istreambuf_iterator<char>(file), {} });
    const std::string difference = FindDifference(SplitLines(this->Options.Description),
      std::get<std::vector<std::string>>(film.at("options")));
    if (!difference.empty())
    {
      throw CommandError(
        BadInput, name + difference + " is not that of --prepare; prepare the film again");
    }
    this->Options.Frames = static_cast<int>(std::get<double>(film.at("images")));
    this->Times = std::get<std::vector<double>>(film.at("times"));
    if (film.count("time") > 0)
    {
      this->FixedTime = std::get<double>(film.at("time"));
    }
    RenderOptions test;
    ApplyFrozen(film, test);
    this->Defaults = film;
  }
  catch (const CommandError&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    throw CommandError(BadInput, name + "the file was not written by --prepare: " + error.what());
  }
  const bool fits = this->Options.Frames > 0 &&
    (this->Times.empty() || static_cast<int>(this->Times.size()) == this->Options.Frames);
  if (!fits || (given > 0 && given != this->Options.Frames))
  {
    throw CommandError(BadInput,
      name + "the film has " + std::to_string(this->Options.Frames) + " images, not " +
        std::to_string(given) + "; prepare it again");
  }
}

}
