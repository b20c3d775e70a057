// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The parts of the irradiance cache benchmark. Each adds its results to the table.
#ifndef penumbra_irradiance_Benchmark_h
#define penumbra_irradiance_Benchmark_h

#include "Occlusion/FrameClock.h"
#include "ResultTable.h"

#include <string>
#include <vector>

namespace penumbra
{

struct IrradianceBenchmark
{
  std::string Meshes;   ///< folder with the .off files of Debian's libcgal-demo
  std::string Output;   ///< folder for results
  std::string Radiance; ///< Python that has pyradiance; empty: skipped
  std::string MeshLab;  ///< Python that has pymeshlab; empty: skipped
  ResultTable Results;
};

/// A unit sphere on and above a plane, 1024 x 1024 pixels, against closed forms and brute force.
/// Also tests whether the error stays below tolerances from 0.05 to 0.002.
void MeasureSpheres(IrradianceBenchmark& benchmark);

/// Walls, rectangle, disc, open plane and closed box against closed forms.
void MeasureForms(IrradianceBenchmark& benchmark);

/// A scan of 104 thousand points against many rays.
void MeasureBaking(IrradianceBenchmark& benchmark);

/// Interreflection in a room and in closed cubes.
void MeasureLight(IrradianceBenchmark& benchmark);

/// A building whose rooms are mostly hidden, sampled with rays and with cube maps.
void MeasureGatherers(IrradianceBenchmark& benchmark);

/// A tree of one million records.
void MeasureRecords(IrradianceBenchmark& benchmark);

}
#endif
