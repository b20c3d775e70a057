// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Peer programs on the same scenes: Benchmarks/Peers/scripts/radiance.py and meshlab.py.
#ifndef penumbra_irradiance_PeerTimings_h
#define penumbra_irradiance_PeerTimings_h

#include "ResultTable.h"

#include <string>

namespace penumbra
{

/// A script that prints one line per setting: error, CPU seconds, and the setting.
struct PeerProgram
{
  std::string Name;
  std::string Python; ///< interpreter of the script; empty: the peer is skipped
  std::string Script; ///< with its arguments
};

/// Adds the ratio of Penumbra's time to the peer's: at its fastest setting with at most the same
/// error, or else at its most accurate setting.
void CompareTimes(ResultTable& table, const std::string& scene, const PeerProgram& rival,
  double error, double seconds, double bar);

}
#endif
