// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Clips triangles by the clipping planes of a mapper.
#ifndef penumbra_SceneExtractionClipping_h
#define penumbra_SceneExtractionClipping_h

#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <vector>

namespace penumbra
{

struct SceneCoordinates;
struct Surface;

/// Keeps the part of `surface` with dot(plane, (x, 1)) >= 0 for every plane; planes are in world
/// coordinates. Normals, colors and texture coordinates are interpolated at the cuts.
VTKPENUMBRAFILTERSSCENE_EXPORT void ClipSurface(
  const std::vector<glm::dvec4>& planes, const SceneCoordinates& coordinates, Surface& surface);

/// Converts a plane from world to scene coordinates.
glm::dvec4 ToScene(glm::dvec4 plane, const SceneCoordinates& coordinates);

}
#endif
