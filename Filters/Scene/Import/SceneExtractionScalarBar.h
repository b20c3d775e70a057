// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Draws vtkScalarBarActor: a color bar, labels and a title.
#ifndef penumbra_SceneExtractionScalarBar_h
#define penumbra_SceneExtractionScalarBar_h

#include "Scene.h"
#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

#include <string>
#include <vector>

class vtkScalarBarActor;
class vtkScalarsToColors;

namespace penumbra
{

/// Draws `bar` into scene.OverlayImage, inside the rectangle of its two positions. The font size is
/// the largest that fits, unless UnconstrainedFontSize is on. Returns false if VTK cannot render
/// text.
bool DrawScalarBar(vtkScalarBarActor* bar, int dpi, Scene& scene);

/// Returns `count` values from the start to the end of the table's range, evenly spaced on the
/// table's linear or logarithmic scale.
VTKPENUMBRAFILTERSSCENE_EXPORT std::vector<double> SampleRange(
  vtkScalarsToColors* table, int count);

/// Formats a label. `format` is a printf or std::format string for one floating-point number; "%g"
/// replaces any other string.
VTKPENUMBRAFILTERSSCENE_EXPORT std::string FormatLabel(const char* format, double value);

}
#endif
