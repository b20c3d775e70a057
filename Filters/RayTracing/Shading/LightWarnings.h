// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lights that do not light what they should: those that contain surfaces, and views that are black
// because no light reaches them.
#ifndef penumbra_LightWarnings_h
#define penumbra_LightWarnings_h

#include "Illumination.h"
#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <string>
#include <vector>

namespace penumbra
{

struct Scene;

/// Returns one sentence, with numbers in world units, for each positional light with a radius that
/// casts shadows and whose sphere contains or touches a surface. Lines and points without a radius
/// are not considered, because they cast no shadows. Shadow rays end at the sphere, so the parts of
/// surfaces inside it cast no shadow, and they are fully lit.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT std::vector<std::string> DescribeLightOverlaps(
  const Scene& scene);

/// Returns one sentence that says what to do if neither direct nor reflected light was found at any
/// surface point that the camera sees in a grid of pixels: the camera may be in a closed box without a
/// light, or the light inside an opaque object. Returns an empty string if light was found, if nothing is
/// in view, if the visible surfaces are black, or if other ranks have parts of surfaces. `shadows`: lights cast
/// shadows. `indirect`: reflected light and that of the environment, which takes a few thousand rays at most;
/// null if there is none.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT std::string DescribeMissingLight(
  const RayScene& rays, bool shadows, const Illumination* indirect);

}
#endif
