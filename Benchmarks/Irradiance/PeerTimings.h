// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Programs of others on the same scenes: Benchmarks/Peers/scripts/radiance.py and meshlab.py.
#ifndef penumbra_irradiance_PeerTimings_h
#define penumbra_irradiance_PeerTimings_h

#include "ResultTable.h"

#include <string>

namespace penumbra
{

/// A script that prints a line a setting: error, CPU seconds, and what was set.
struct PeerProgram
{
  std::string Name;
  std::string Python; ///< that runs it; empty: nothing is asked
  std::string Script; ///< with its arguments
};

/// Adds to the table what share of the rival's time ours is: of its fastest setting that errs no more than
/// ours does, else of the one that errs least.
void CompareTimes(ResultTable& table, const std::string& scene, const PeerProgram& rival,
  double error, double seconds, double bar);

}
#endif
