// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Visible parts of lines and points. Both halves of the width of a line are tested along their sides.
#ifndef penumbra_VisibleStrokes_h
#define penumbra_VisibleStrokes_h

#include "Sampling/CameraRayTracer.h"
#include "VectorFigure.h"

#include <vector>

namespace penumbra
{

/// Returns true if AddVisibleLines() draws a surface: opaque or translucent lines and points that are
/// not round, without textures, splats, and wireframes with hidden lines.
bool HasStrokes(const Surface& surface);

/// Appends the visible parts of the lines and points of the scene, back to front. `tracer` traces
/// the scene with its lines and points. Parts that are visible over their whole width are strokes
/// along their axis; others are polygons.
void AddVisibleLines(const CameraRayTracer& tracer, std::vector<FigurePath>& paths);

}
#endif
