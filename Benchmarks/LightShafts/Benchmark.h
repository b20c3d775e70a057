// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The parts of the light shaft benchmark. Each adds its results to the table.
#ifndef penumbra_LightShaftBenchmark_h
#define penumbra_LightShaftBenchmark_h

#include "ResultTable.h"

#include <string>
#include <vector>

namespace penumbra
{

struct ShaftBenchmark
{
  std::string Output;  ///< folder for results, images and the peers' scene files
  std::string PovRay;  ///< program; empty: no comparison with it
  std::string Mitsuba; ///< Python that has it; empty: no comparison with it
  bool Diagnose = false;
  ResultTable Results;
};

/// Writes the in-scattered light of several images next to each other; white is the radiance of an
/// opaque medium. `width` pixels each.
void WriteImage(const std::string& path, const std::vector<std::vector<double>>& parts, int width);

/// The marched reference against the closed form, and its speed against POV-Ray's media.
void MeasureMarched(ShaftBenchmark& benchmark);

/// The pass against the marched reference.
void MeasureAccuracy(ShaftBenchmark& benchmark);

/// Chained passes against one loop.
void MeasureChained(ShaftBenchmark& benchmark);

/// Cost of the pass in static and moving views.
void MeasureCost(ShaftBenchmark& benchmark);

/// Motion: a light that sweeps, an occluder that crosses the image edge.
void MeasureMotion(ShaftBenchmark& benchmark);

}
#endif
