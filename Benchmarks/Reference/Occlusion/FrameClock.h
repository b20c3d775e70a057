// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The clock of frames: CPU seconds, or elapsed seconds on a graphics card.
#ifndef penumbra_FrameClock_h
#define penumbra_FrameClock_h

#include <chrono>
#include <ctime>
#include <string>

namespace penumbra
{

/// Set by the option --elapsed of the benchmarks of passes.
inline bool FramesAreElapsed = false;

/// CPU seconds of the process, which other processes hardly change and in which OSMesa renders on one thread; elapsed
/// seconds, which a graphics card needs, if FramesAreElapsed. A frame ends with vtkRenderWindow::WaitForCompletion().
inline double FrameSeconds()
{
  if (FramesAreElapsed)
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
  }
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// What a table's head says of the clock.
inline std::string DescribeFrameClock()
{
  return FramesAreElapsed ? "elapsed seconds" : "CPU seconds";
}

}
#endif
