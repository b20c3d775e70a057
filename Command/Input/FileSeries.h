// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Files that list other files: of a time series (ParaView's .pvd, and .series in JSON), blocks or pieces.
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

/// Returns the files of blocks or pieces that a file of VTK's XML formats refers to, with its folder.
std::vector<std::string> FindPieces(const std::string& path);

}
#endif
