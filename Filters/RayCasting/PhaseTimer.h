// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Elapsed time of the phases of an execution, one after the other.
#ifndef penumbra_PhaseTimer_h
#define penumbra_PhaseTimer_h

#include "vtkPenumbraRayCaster.h"

#include <array>
#include <chrono>

namespace penumbra
{

/// Seconds per phase, see vtkPenumbraRayCaster::Phases.
using PhaseTimes = std::array<double, vtkPenumbraRayCaster::TRACING + 1>;

/// Adds elapsed times to those of phases.
class PhaseTimer
{
public:
  explicit PhaseTimer(PhaseTimes& seconds)
    : Seconds(seconds)
  {
  }

  /// Adds the time since the construction or since the end of the last phase to that of a phase.
  void End(vtkPenumbraRayCaster::Phases phase)
  {
    const auto now = std::chrono::steady_clock::now();
    this->Seconds[phase] += std::chrono::duration<double>(now - this->Start).count();
    this->Start = now;
  }

private:
  PhaseTimes& Seconds;
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};

}
#endif
