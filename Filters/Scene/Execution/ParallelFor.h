// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Parallel loops that pass exceptions on to the caller, report progress and can be stopped. Threads
// take the next iterations when they have finished their last ones, without barriers. The number of
// threads is that of vtkSMPTools. Loops inside of loops run in one thread.
#ifndef penumbra_ParallelFor_h
#define penumbra_ParallelFor_h

#include "vtkPenumbraFiltersSceneModule.h" // for export macro

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace penumbra
{

/// Receives the fraction of the work that is done, in the calling thread. Returns true to request a
/// stop.
using ProgressCallback = std::function<bool(double)>;

/// Thrown on a stop request by functions that cannot report it in their result.
struct Stopped
{
};

/// Number of cells that are processed between two calls of the progress callback.
constexpr int StoppableCells = 16384;

/// Reports progress and throws Stopped on a stop request.
inline void ThrowIfStopped(const ProgressCallback& progress, double fraction)
{
  if (progress && progress(fraction))
  {
    throw Stopped();
  }
}

/// Number of tasks of a loop that chooses their size itself: at least 8 for each of 64 cores.
constexpr std::int64_t AutomaticTasks = 1024;

/// Number of iterations per task of loops over arrays, whose iterations take a few nanoseconds.
constexpr std::size_t ArrayGrain = 8192;

/// Calls range(first, last) for parts of [0, count) of `grain` iterations, in this thread and in
/// others. `isStopped`, unless empty, is called in this thread about every 50 ms with the number of
/// iterations that are done; no further part begins when it has returned true. Returns false in that
/// case. Rethrows one exception of `range`.
VTKPENUMBRAFILTERSSCENE_EXPORT bool RunParallel(std::int64_t count, std::int64_t grain,
  const std::function<void(std::int64_t, std::int64_t)>& range,
  const std::function<bool(std::int64_t)>& isStopped);

/// What the parallel loops of this process did, for benchmarks and tests. Loops inside of loops and
/// those of a single task do not count.
struct ParallelLoopTotals
{
  double Seconds = 0.0;          ///< elapsed time of all loops
  std::int64_t FewestTasks = -1; ///< of a loop of 10 ms or more; -1 if there was none
};

/// Returns the totals since the last call.
VTKPENUMBRAFILTERSSCENE_EXPORT ParallelLoopTotals TakeParallelLoopTotals();

/// Returns `grain`, or if it is 0 the number of iterations of a task.
inline std::int64_t ChooseGrain(std::int64_t count, std::int64_t grain)
{
  return grain > 0 ? grain : std::max<std::int64_t>(count / AutomaticTasks, 1);
}

/// Runs work(i) for i in [begin, end) in parallel. `grain` is the number of consecutive iterations
/// per task; 0: chosen automatically.
template <typename Index, typename Work>
void ParallelFor(Index begin, Index end, Index grain, const Work& work)
{
  const std::int64_t count = static_cast<std::int64_t>(end) - static_cast<std::int64_t>(begin);
  RunParallel(
    count, ChooseGrain(count, static_cast<std::int64_t>(grain)),
    [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        work(static_cast<Index>(begin + static_cast<Index>(i)));
      }
    },
    nullptr);
}

/// Runs work(i) for i in [0, count) in parallel and reports progress in [from, to] before the first
/// iteration, about every 50 ms, and after the last one. `grain` is as above. Returns false if
/// stopped.
template <typename Work>
bool ParallelForWithProgress(int count, double from, double to, const ProgressCallback& progress,
  const Work& work, int grain = 1)
{
  if (progress && progress(from))
  {
    return false;
  }
  std::function<bool(std::int64_t)> isStopped;
  if (progress)
  {
    isStopped = [&](std::int64_t done) {
      return progress(from + (to - from) * static_cast<double>(done) / count);
    };
  }
  const bool finished = RunParallel(
    count, ChooseGrain(count, grain),
    [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        work(static_cast<int>(i));
      }
    },
    isStopped);
  return finished && !(progress && progress(to));
}

/// Boundaries of consecutive parts of [0, count), each of which fills containers of its own in a
/// parallel loop. There are at most AutomaticTasks, of at least `minimum` iterations unless there
/// is only one.
inline std::vector<std::size_t> SplitIntoParts(std::size_t count, std::size_t minimum)
{
  const std::size_t parts = std::clamp<std::size_t>(
    count / std::max<std::size_t>(minimum, 1), 1, static_cast<std::size_t>(AutomaticTasks));
  std::vector<std::size_t> boundaries(parts + 1);
  for (std::size_t part = 0; part <= parts; ++part)
  {
    boundaries[part] = count / parts * part + std::min(part, count % parts);
  }
  return boundaries;
}

}
#endif
