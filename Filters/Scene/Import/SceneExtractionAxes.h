// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Converts cube axes to the lines and polygons that VTK computes for the size of the image.
#ifndef penumbra_SceneExtractionAxes_h
#define penumbra_SceneExtractionAxes_h

#include "SceneExtraction.h"
#include "Tessellation/SceneExtractionItem.h"

#include <vector>

class vtkProp;
class vtkRenderer;

namespace penumbra
{

/// Returns true if MakeCubeAxes() draws this prop.
bool IsCubeAxes(vtkProp* prop);

/// Returns the parts of the visible cube axes of `renderer` for an image of the size of
/// scene.ViewCamera. The first has the ObjectId `firstObject`.
std::vector<DrawItem> MakeCubeAxes(vtkRenderer* renderer, int dpi, int firstObject, Scene& scene);

}
#endif
