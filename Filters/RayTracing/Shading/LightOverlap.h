// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Surfaces inside the sphere of a light. Shadow rays end at the sphere, so the parts of surfaces
// inside it cast no shadow, and they are fully lit.
#ifndef penumbra_LightOverlap_h
#define penumbra_LightOverlap_h

#include "Scene.h"
#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <string>
#include <vector>

namespace penumbra
{

/// Returns one sentence, with numbers in world units, for each positional light with a radius that
/// casts shadows and whose sphere contains or touches a surface. Lines and points without a radius
/// are not considered, because they cast no shadows.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT std::vector<std::string> DescribeLightOverlaps(
  const Scene& scene);

}
#endif
