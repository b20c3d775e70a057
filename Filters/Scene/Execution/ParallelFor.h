// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Parallel loops that pass exceptions on to the caller, report progress and can be stopped.
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

/// Runs work(i) for i in [begin, end) in parallel. `grain` is the minimum number of consecutive
/// iterations per task; 0 lets VTK choose. One exception is rethrown in the calling thread, because
/// VTK's threads would only print it and continue.
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

/// Runs work(i) for i in [0, count) in parallel batches and reports progress in [from, to] before
/// the first and after each batch. `grain` is as above. The batch size adapts so that a batch takes
/// 100 to 300 ms, which bounds the delay of a stop request. Returns false if stopped.
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
