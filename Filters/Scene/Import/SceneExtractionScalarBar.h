// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The legend of a lookup table: a band of colours, labels, a title.
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

/// Draws `bar` into scene.Over, inside the rectangle of its two positions; text is as large as
/// fits, unless the bar's font sizes are unconstrained. False where no text can be drawn.
bool DrawScalarBar(vtkScalarBarActor* bar, int dpi, Scene& scene);

/// `count` values from one end of the table's range to the other, evenly or in its logarithm.
VTKPENUMBRAFILTERSSCENE_EXPORT std::vector<double> SampleRange(
  vtkScalarsToColors* table, int count);

/// A number as a label, in the style of a printf format if it is one for one floating point number;
/// else as by "%g".
VTKPENUMBRAFILTERSSCENE_EXPORT std::string FormatLabel(const char* format, double value);

}
#endif
