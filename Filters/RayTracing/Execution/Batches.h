// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Parallel loops whose exceptions reach the caller; with progress, and stopped between batches.
#ifndef penumbra_Batches_h
#define penumbra_Batches_h

#include "vtkSMPTools.h"

#include <algorithm>
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

/// Runs work(i) for i in [0, count) in parallel batches, with progress from `from` to `to` between.
template <typename Work>
bool InBatches(
  int count, double from, double to, const ProgressCallback& progress, const Work& work)
{
  constexpr int Batches = 16;
  const int step = std::max((count + Batches - 1) / Batches, 1);
  for (int first = 0; first < count; first += step)
  {
    ParallelFor(first, std::min(first + step, count), 1, work);
    if (progress && progress(from + (to - from) * std::min(first + step, count) / count))
    {
      return false;
    }
  }
  return true;
}

}
#endif
