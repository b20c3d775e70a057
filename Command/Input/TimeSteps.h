// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Time steps inside of files and of file series.
#ifndef penumbra_TimeSteps_h
#define penumbra_TimeSteps_h

#include <cstddef>
#include <string>
#include <vector>

class vtkAlgorithm;

namespace penumbra
{

/// The times of one or several inputs.
struct Timeline
{
  std::vector<double> Times; ///< ascending; empty: no time steps
  bool IsContinuous =
    false; ///< an animation is defined at all times between the first and the last
};

/// Returns whether the format of `path` can hold time steps.
bool MayHaveTimeSteps(const std::string& path);

/// Returns all times of the files. Throws CommandError, naming the file, if one cannot be read.
Timeline ReadTimeline(const std::vector<std::string>& files);

/// Returns the index of the step shown at `time`: the last one that is not later, apart from
/// rounding, else the first. `times` is ascending and not empty.
std::size_t FindStep(const std::vector<double>& times, double time);

/// Returns the time steps of `reader` after updating its information; enables animations of glTF.
std::vector<double> UpdateTimes(vtkAlgorithm* reader);

/// Updates `reader` at the step shown at `time`, an animation of glTF at `time` itself.
void UpdateAtTime(vtkAlgorithm* reader, double time);

}
#endif
