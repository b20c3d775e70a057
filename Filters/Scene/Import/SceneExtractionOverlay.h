// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Flat props over the picture: text and scalar bars.
#ifndef penumbra_SceneExtractionOverlay_h
#define penumbra_SceneExtractionOverlay_h

#include "SceneExtraction.h"

#include <string>

class vtkCoordinate;
class vtkProp;
class vtkScalarBarActor;
class vtkTextProperty;

namespace penumbra
{

/// Draws text actors and scalar bars of `renderer` into scene.Over. The camera of `scene` must be
/// set.
void ExtractOverlay(vtkRenderer* renderer, const ExtractionOptions& options, Scene& scene);

/// Is this a prop that ExtractOverlay() draws?
bool IsOverlay(vtkProp* prop);

/// Where a coordinate of a prop lies, in pixels.
glm::dvec2 ComputePixelPosition(vtkCoordinate* coordinate, const Scene& scene);

/// Draws text anchored at `at` by the property's justification. False where no text can be drawn.
bool DrawText(
  const std::string& text, vtkTextProperty* property, glm::dvec2 anchor, int dpi, Overlay& overlay);

}
#endif
