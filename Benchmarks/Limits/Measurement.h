// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// CPU time and peak memory of tasks, each of which runs in a process of its own.
#ifndef penumbra_Measurement_h
#define penumbra_Measurement_h

#include <functional>
#include <string>
#include <vector>

namespace penumbra
{

struct Cost
{
  double Seconds = 0.0;   ///< of CPU time, the smallest of up to three runs if these are short
  double Megabytes = 0.0; ///< peak resident memory of the process
  bool IsBound = false;   ///< the task was ended at the limit; the cost is a lower bound
};

/// Prepares the input of a task and returns the task. Only the task is timed.
using TaskFactory = std::function<std::function<void()>()>;

struct NamedTask
{
  std::string Name; ///< printed with the cost
  TaskFactory Make;
};

/// Measures each task in a child process, `jobs` of them at a time. A child is ended after `limit`
/// CPU seconds. Throws std::runtime_error if a process cannot be started or fails otherwise.
std::vector<Cost> MeasureInProcesses(const std::vector<NamedTask>& tasks, int jobs, int limit);

}
#endif
