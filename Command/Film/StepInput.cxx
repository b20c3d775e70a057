// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "StepInput.h"

#include "Engines/RenderOutput.h"
#include "Files/JsonObject.h"
#include "Options/FrozenOptions.h"
#include "Options/RenderOptions.h"
#include "Processes/CommandError.h"
#include "Processes/ProgressLine.h"
#include "Processes/Worker.h"
#include "Processes/WorkerTexts.h"
#include "Scene/SceneBuilder.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"

#include <algorithm>

namespace penumbra
{

namespace
{

// Returns the array and the range of one step; empty if it has none. Throws CommandError if the step cannot be read.
std::string FindRange(const StepInput& step, RenderOptions options)
{
  try
  {
    return DescribeStep(step, options, [&options](vtkRenderer* renderer) {
      ColoringOptions& coloring = options.Coloring;
      FreezeColoring(renderer, coloring);
      return coloring.Range.empty()
        ? std::string()
        : FormatJsonObject({ { "array", coloring.Array }, { "range", coloring.Range } });
    });
  }
  catch (const IncompleteStep&)
  {
    return std::string(); // Its image reports the error.
  }
}

}

std::string DescribeStep(const StepInput& step, const RenderOptions& options,
  const std::function<std::string(vtkRenderer*)>& describe)
{
  ProgressLine silent("none");
  std::vector<std::string> ignored;
  const Surfaces surfaces =
    ReadMeshes(step.Files, GetInputOptions(options, step.Time, true), silent, ignored);
  if (surfaces.Meshes.empty())
  {
    return std::string();
  }
  try
  {
    return describe(BuildScene(surfaces, options, 1.0));
  }
  catch (const CommandError& error)
  {
    throw IncompleteStep(error.ExitStatus, error.what());
  }
}

int ReadTimelines(
  const std::vector<std::vector<std::string>>& groups, int jobs, std::vector<Timeline>& timelines)
{
  const auto read = [&groups](int i) {
    EnterPhase(groups[i].front(), BadInput);
    const Timeline timeline = ReadTimeline(groups[i]);
    return FormatJsonObject(
      { { "times", timeline.Times }, { "continuous", timeline.IsContinuous ? 1.0 : 0.0 } });
  };
  std::vector<std::string> texts;
  const int status = RunForTexts(static_cast<int>(groups.size()), jobs, read, texts);
  for (const std::string& text : texts)
  {
    timelines.emplace_back();
    if (!text.empty())
    {
      const JsonObject timeline = ParseJsonObject(text);
      timelines.back() = { std::get<std::vector<double>>(timeline.at("times")),
        std::get<double>(timeline.at("continuous")) != 0.0 };
    }
  }
  return status;
}

int SetRangeOfAllSteps(const std::vector<StepInput>& steps, RenderOptions& options)
{
  std::vector<std::string> texts;
  const int status = RunForTexts(
    static_cast<int>(steps.size()), options.Jobs,
    [&](int i) { return FindRange(steps[i], options); }, texts);
  ColoringOptions& coloring = options.Coloring;
  for (const std::string& text : texts)
  {
    if (text.empty())
    {
      continue;
    }
    const JsonObject found = ParseJsonObject(text);
    const auto range = std::get<std::vector<double>>(found.at("range"));
    const auto array = std::get<std::string>(found.at("array"));
    if (coloring.Range.empty())
    {
      coloring.Array = array;
      coloring.Range = range;
    }
    else if (coloring.Array == array)
    {
      coloring.Range = { std::min(coloring.Range[0], range[0]),
        std::max(coloring.Range[1], range[1]) };
    }
  }
  return status;
}

}
