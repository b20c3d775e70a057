// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What lies at the centres of pixels, beside their colour.
#ifndef penumbra_GeometryArrays_h
#define penumbra_GeometryArrays_h

#include "Execution/ParallelFor.h"
#include "Sampling/CameraRayTracer.h"

class vtkImageData;

namespace penumbra
{

/// Adds `Depth`, `Normal`, `ObjectId`, `CellId` and, where the sampler asks for it,
/// `AmbientOcclusion` for the extent of `image`, and the rays traced to `counts`. False when `progress` stopped it.
bool AddGeometryArrays(const CameraRayTracer& sampler, const ProgressCallback& progress,
  vtkImageData* image, RayCounts& counts);

}
#endif
