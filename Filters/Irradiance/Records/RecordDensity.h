// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Tells from a coarse grid of pixels whether records pay: on smooth surfaces, only few points of a finer
// grid need a record of their own.
#ifndef penumbra_RecordDensity_h
#define penumbra_RecordDensity_h

#include "RecordPlacement.h"

namespace penumbra
{

class RayScene;

/// Fewest reflections with which records may replace joined pixels: the shorter paths are, the fewer rays joined
/// pixels take, and they have no noise where surfaces touch.
constexpr int MinimumRecordReflections = 3;

/// Places records at visible points, level by level as ViewRecords does, and discards them. Returns false
/// as soon as more than a fraction of the points of a level needed one, or if there are no points.
/// Adds the rays traced to `traced`. Throws Stopped if `progress` requests a stop.
VTKPENUMBRAFILTERSIRRADIANCE_EXPORT bool NeedsFewRecords(const RayScene& rays,
  const Gatherer& gatherer, const RecordPlacementSettings& settings, float normalAngle,
  const ProgressCallback& progress, long long& traced);

}
#endif
