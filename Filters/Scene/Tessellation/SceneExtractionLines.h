// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Expands line and vertex cells, wireframes, point representations, visible edges and visible
// vertices to quads with an exact width in pixels.
#ifndef penumbra_SceneExtractionLines_h
#define penumbra_SceneExtractionLines_h

#include "SceneExtractionItem.h"
#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

namespace penumbra
{

/// Adds the parts of `item` that are drawn as lines and points to `scene`. `pixelsPerPoint` is the
/// width in pixels of a line of width 1.
VTKPENUMBRAFILTERSSCENE_EXPORT void AddLinesAndPoints(
  const DrawItem& item, double pixelsPerPoint, Scene& scene);

}
#endif
