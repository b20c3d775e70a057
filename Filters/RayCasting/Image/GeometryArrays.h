// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Arrays of the geometry at pixel centers (AOVs).
#ifndef penumbra_GeometryArrays_h
#define penumbra_GeometryArrays_h

#include "Execution/ParallelFor.h"
#include "Sampling/CameraRayTracer.h"

class vtkImageData;

namespace penumbra
{

/// Adds `Depth`, `Normal`, `ObjectId`, `CellId` and `AmbientOcclusion` for the extent of `image`.
/// `tracer` must have an occlusion provider. Adds the number of rays to `counts`. Returns false if
/// `progress` requested a stop.
bool AddGeometryArrays(const CameraRayTracer& tracer, const ProgressCallback& progress,
  vtkImageData* image, RayCounts& counts);

}
#endif
