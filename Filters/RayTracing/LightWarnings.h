// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lights that do not light what they should: those that contain surfaces, and views that are black
// because no light reaches them.
#ifndef penumbra_LightWarnings_h
#define penumbra_LightWarnings_h

#include "Shading/Illumination.h"
#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <functional>
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

/// What FindLight() has found.
struct FoundLight
{
  bool IsLit = false;  ///< direct or reflected light, or that of an environment
  bool IsDark = false; ///< a surface that reflects light and gets none
};

/// Searches for light at the surface points that the camera sees in a grid of pixels, until it is found.
/// `shadows`: lights cast shadows. `indirect`: reflected light and that of the environment, which takes a few
/// thousand rays at most; null if there is none. `isAsked`: returns false for the pixels to skip; if empty, none are.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT FoundLight FindLight(const RayScene& rays, bool shadows,
  const Illumination* indirect, const std::function<bool(glm::ivec2)>& isAsked = {});

/// Returns one sentence that says what to do if surfaces are in view and no light was found: the camera may be in
/// a closed box without a light, or the light inside an opaque object. Otherwise, returns an empty string.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT std::string DescribeMissingLight(const FoundLight& found);

/// Returns one sentence that says what to do if the scene consists of lines and points that have no lighting, as in
/// VTK. Otherwise, returns an empty string.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT std::string DescribeUnlitLines(const Scene& scene);

}
#endif
