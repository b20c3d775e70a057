// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lines and points: line and vertex cells, wireframes, points, visible edges and vertices, widened
// to exact widths in pixels.
#ifndef penumbra_SceneExtractionLines_h
#define penumbra_SceneExtractionLines_h

#include "SceneExtractionItem.h"

namespace penumbra
{

/// Adds what of `piece` is drawn as lines and points. `pixelsPerPoint`: the width in pixels of
/// what is one wide.
void AddLinesAndPoints(const DrawItem& item, double pixelsPerPoint, Scene& scene);

}
#endif
