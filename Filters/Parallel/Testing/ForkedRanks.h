// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Runs a function on several ranks without MPI: processes that are connected by sockets.
#ifndef ForkedRanks_h
#define ForkedRanks_h

#include <functional>
#include <string>
#include <vector>

namespace penumbra
{

struct RankResult
{
  std::string Value;        ///< what the function returned
  long long PeakMemory = 0; ///< of the process, in bytes
  bool HasReturned = false; ///< false if the process was ended before
};

/// Calls `work` in `count` new processes, whose global controllers connect them as ranks. VTK must not have
/// started threads in this process. Processes that take longer than `seconds` are ended.
std::vector<RankResult> RunRanks(
  int count, const std::function<std::string(int rank)>& work, unsigned int seconds = 120);

}
#endif
