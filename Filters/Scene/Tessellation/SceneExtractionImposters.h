// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Converts the points of vtkOpenGLSphereMapper and vtkOpenGLStickMapper, which VTK draws as
// imposters, to spheres and to cylinders with flat ends.
#ifndef penumbra_SceneExtractionImposters_h
#define penumbra_SceneExtractionImposters_h

#include "ImposterSettings.h"
#include "SceneExtractionItem.h"
#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

#include <string>
#include <vector>

namespace penumbra
{

/// Returns a draw item with an imposter for each point of `data`. `prototype` provides the
/// transform and the property, `colors` the colors per point. Spheres whose radius, and sticks whose
/// radius, length or orientation is not positive and finite are skipped with a warning, and so are
/// all sticks without a valid array. An array of radii of the wrong length is ignored with a
/// warning. [VTK vtkOpenGLSphereMapper, vtkOpenGLStickMapper]
VTKPENUMBRAFILTERSSCENE_EXPORT DrawItem MakeImposters(const ImposterSettings& settings,
  vtkPolyData* data, const DrawItem& prototype, const Coloring& colors,
  std::vector<std::string>& warnings);

}
#endif
