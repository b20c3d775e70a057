// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Files that list the files of a time series: ParaView's .pvd, and .series in JSON.
#ifndef penumbra_FileSeries_h
#define penumbra_FileSeries_h

#include <string>
#include <vector>

namespace penumbra
{

/// One time step of a series.
struct SeriesStep
{
  double Time = 0.0;
  std::vector<std::string> Files; ///< parts, with the folder of the series
};

/// Returns whether the name of `path` ends in .pvd or .series.
bool IsFileSeries(const std::string& path);

/// Reads the steps of a series in ascending order of time. Throws CommandError if the file is not
/// valid or lists no file.
std::vector<SeriesStep> ReadFileSeries(const std::string& path);

}
#endif
