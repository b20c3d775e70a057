// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Parallel loops that report progress and can be stopped between batches.
#ifndef penumbra_Batches_h
#define penumbra_Batches_h

#include "vtkSMPTools.h"

#include <algorithm>
#include <functional>

namespace penumbra
{

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
    vtkSMPTools::For(first, std::min(first + step, count), 1, [&](vtkIdType begin, vtkIdType end) {
      for (vtkIdType i = begin; i < end; ++i)
      {
        work(static_cast<int>(i));
      }
    });
    if (progress && progress(from + (to - from) * std::min(first + step, count) / count))
    {
      return false;
    }
  }
  return true;
}

}
#endif
