// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Parallel loops whose exceptions reach the caller; with progress, and stopped between batches.
#ifndef penumbra_ParallelFor_h
#define penumbra_ParallelFor_h

#include "vtkSMPTools.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <functional>
#include <mutex>

namespace penumbra
{

/// Runs work(i) for i in [begin, end) in parallel, chunks of at least `grain` on one thread (0: VTK
/// chooses). An exception of one is thrown again here: VTK's threads would only print it and go on.
template <typename Index, typename Work>
void ParallelFor(Index begin, Index end, Index grain, const Work& work)
{
  std::exception_ptr thrown;
  std::mutex mutex;
  vtkSMPTools::For(static_cast<vtkIdType>(begin), static_cast<vtkIdType>(end),
    static_cast<vtkIdType>(grain), [&](vtkIdType first, vtkIdType last) {
      try
      {
        for (vtkIdType i = first; i < last; ++i)
        {
          work(static_cast<Index>(i));
        }
      }
      catch (...)
      {
        const std::lock_guard<std::mutex> lock(mutex);
        thrown = std::current_exception();
      }
    });
  if (thrown)
  {
    std::rethrow_exception(thrown);
  }
}

/// Told the share of the work that is done, from the calling thread; true asks to stop.
using ProgressCallback = std::function<bool(double)>;

/// Thrown where one asked to stop and the work cannot return so.
struct Stopped
{
};

/// So many cells are read between two questions.
constexpr int StoppableCells = 16384;

inline void ThrowIfStopped(const ProgressCallback& progress, double fraction)
{
  if (progress && progress(fraction))
  {
    throw Stopped();
  }
}

/// Runs work(i) for i in [0, count) in parallel batches, with progress from `from` to `to` before and
/// between, each in chunks of `grain` as above. Batches follow the clock: few begin after one asked to stop. False when stopped.
template <typename Work>
bool ParallelForBatches(int count, double from, double to, const ProgressCallback& progress,
  const Work& work, int grain = 1)
{
  using Clock = std::chrono::steady_clock;
  constexpr int MinimumBatches = 16;
  constexpr std::chrono::milliseconds minimumDuration(100);
  constexpr std::chrono::milliseconds maximumDuration(300);
  if (!progress)
  {
    ParallelFor(0, count, grain, work);
    return true;
  }
  if (progress(from))
  {
    return false;
  }
  const int maximumStep = std::max((count + MinimumBatches - 1) / MinimumBatches, 1);
  const int minimumStep =
    std::min(std::max(vtkSMPTools::GetEstimatedNumberOfThreads(), 1), maximumStep);
  for (int first = 0, step = minimumStep; first < count;)
  {
    const int end = step < count - first ? first + step : count;
    const Clock::time_point start = Clock::now();
    ParallelFor(first, end, grain, work);
    const Clock::duration elapsed = Clock::now() - start;
    if (progress(from + (to - from) * end / count))
    {
      return false;
    }
    step = elapsed < minimumDuration ? std::min(step, maximumStep / 2) * 2
      : elapsed > maximumDuration    ? step / 2
                                     : step;
    step = std::clamp(step, minimumStep, maximumStep);
    first = end;
  }
  return true;
}

}
#endif
