// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The parts of the benchmark of large scenes.
#ifndef Benchmark_h
#define Benchmark_h

#include "Program.h"

#include <string>

struct Options
{
  std::string Meshes;
  std::string Output;
  std::string Python; ///< interpreter with PyVista; empty: no comparison
  penumbra::ResultTable Results;
};

/// Measures memory, occlusion and time of a million points that are rendered as spheres.
void MeasureSpheres(Options& options);

/// Measures the time of the first image of a view of a million triangles in a window.
void MeasurePreviews(Options& options);

/// Measures memory, time and serial share of an image of ten million triangles.
void MeasureTriangles(Options& options);

/// Measures what ranks exchange to render blocks of a million triangles each. Call it before VTK has started
/// threads.
void MeasureRanks(Options& options);

/// The same for baking, with blocks of 1 % of the triangles.
void MeasureBakingOnRanks(Options& options);

#endif
