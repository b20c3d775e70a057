// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What one image of a time series reads.
#ifndef penumbra_StepInput_h
#define penumbra_StepInput_h

#include "Input/TimeSteps.h"
#include "Processes/CommandError.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

class vtkRenderer;

namespace penumbra
{

struct RenderOptions;

struct StepInput
{
  std::vector<std::string> Files;
  std::optional<double> Time; ///< unset: the first step, or files without steps
};

/// Error of a step that can be read, but lacks what an option names, such as an array.
class IncompleteStep : public CommandError
{
public:
  using CommandError::CommandError;
};

/// Returns what `describe` returns for the scene of a step; empty if the step shows nothing. Throws CommandError if the
/// step cannot be read, IncompleteStep if BuildScene() or `describe` throws CommandError.
std::string DescribeStep(const StepInput& step, const RenderOptions& options,
  const std::function<std::string(vtkRenderer*)>& describe);

/// Reads the times of each group of files, in worker processes. Returns the largest exit status.
int ReadTimelines(
  const std::vector<std::vector<std::string>>& groups, int jobs, std::vector<Timeline>& timelines);

/// Sets the array and the range of --coloring-range all from all steps, in worker processes. Steps
/// that lack the array are left out. Returns the largest exit status: BadInput if a step cannot be read.
int SetRangeOfAllSteps(const std::vector<StepInput>& steps, RenderOptions& options);

}
#endif
