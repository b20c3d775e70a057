// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Ambient occlusion along a ray through translucent surfaces: a surface of opacity a occludes the
// fraction a of what the surfaces in front of it let pass.
#ifndef penumbra_TranslucentOcclusion_h
#define penumbra_TranslucentOcclusion_h

#include "DistanceFalloff.h"
#include "Embree/RayScene.h"
#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which other modules need

#include <vector>

namespace penumbra
{

/// Returns true if a surface other than lines and points is translucent. Otherwise every hit
/// occludes completely.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT bool HasTranslucentOccluders(
  const std::vector<Surface>& surfaces);

/// Returns the transmittance below which a ray ends, if the mean of many is estimated to `tolerance`.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT float ComputeOcclusionCut(double tolerance);

/// Returns the occlusion along `ray`, in [0, 1], whose first hit, without lines and points, is
/// `hit`. `falloff` is in scene units. Layers behind a transmittance of less than `cut` are ignored.
/// Adds the number of further rays traced to `count`.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT float TraceTranslucentOcclusion(const RayScene& rays, Ray ray,
  Hit hit, const DistanceFalloff& falloff, float cut, long long& count);

}
#endif
