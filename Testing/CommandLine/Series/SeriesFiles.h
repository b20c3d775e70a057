// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Small time series in every format that has time steps: three steps at the times 0, 0.5 and 1.5. Each
// shows a square of side 2, or a face of this size, whose array T is the number of the step.
#ifndef penumbra_testing_SeriesFiles_h
#define penumbra_testing_SeriesFiles_h

#include "Program.h"

#include <string>
#include <vector>

namespace penumbra_testing
{

/// The square with its center at (x, 0, 0) and T = value, as legacy .vtk.
std::string SquareWithValue(double x, double value);

/// A time series.
struct SeriesFile
{
  std::string Path;
  bool IsColored = true; ///< has the array T; otherwise the square moves by its side
};

/// Writes the steps run_8.vtk, run_9.vtk and run_10.vtk with centers at x = 0, 0.25 and 0.5, and
/// lists of them: run.pvd, run.vtk.series.
void WriteFileSeries(const Folder& folder);

/// Writes series of all formats whose readers this build has.
std::vector<SeriesFile> WriteSeries(const Folder& folder);

}
#endif
