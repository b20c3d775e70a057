// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PeerTimings.h"

#include <cstdio>
#include <stdexcept>

namespace penumbra
{

void CompareTimes(ResultTable& table, const std::string& scene, const PeerProgram& rival,
  double error, double seconds, double bar)
{
  if (rival.Python.empty())
  {
    return;
  }
  const std::string command = "'" + rival.Python + "' Benchmarks/Peers/scripts/" + rival.Script;
  FILE* answers = popen(command.c_str(), "r");
  if (!answers)
  {
    throw std::runtime_error("cannot run " + command);
  }
  double bestError = 0.0;
  double bestSeconds = 0.0;
  std::string bestSetting;
  char line[512];
  while (std::fgets(line, sizeof line, answers))
  {
    double itsError;
    double itsSeconds;
    char setting[400] = "";
    if (std::sscanf(line, "%lf %lf %399[^\n]", &itsError, &itsSeconds, setting) != 3)
    {
      continue;
    }
    std::printf("  %s: %s", rival.Name.c_str(), line);
    const bool reaches = itsError <= error;
    const bool better = bestSetting.empty() || (bestError > error && itsError < bestError) ||
      (reaches && bestError <= error && itsSeconds < bestSeconds);
    if (better)
    {
      bestError = itsError;
      bestSeconds = itsSeconds;
      bestSetting = setting;
    }
  }
  if (pclose(answers) != 0 || bestSetting.empty())
  {
    throw std::runtime_error(rival.Name + " failed: " + command);
  }
  char remark[600];
  std::snprintf(remark, sizeof remark, "Penumbra %.4f in %.2f s; peer %.4f in %.2f s (%s)", error,
    seconds, bestError, bestSeconds, bestSetting.c_str());
  table.Add(scene, "time, ours over " + rival.Name + "'s", seconds / bestSeconds,
    TargetKind::AtMost, bar, remark);
}

}
