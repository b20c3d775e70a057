// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Cutting triangles by planes: a mapper's clipping planes.
#ifndef penumbra_SceneExtractionClipping_h
#define penumbra_SceneExtractionClipping_h

#include "Scene.h"
#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

#include <vector>

namespace penumbra
{

/// Keeps of `surface` what has dot(plane, (x, 1)) >= 0 for every plane (in world coordinates);
/// normals, colours and texture coordinates are interpolated at the cuts.
VTKPENUMBRAFILTERSSCENE_EXPORT void ClipSurface(
  const std::vector<glm::dvec4>& planes, const Scene& scene, Surface& surface);

/// A plane in world coordinates as one in scene coordinates.
glm::dvec4 ToScene(glm::dvec4 plane, const Scene& scene);

}
#endif
