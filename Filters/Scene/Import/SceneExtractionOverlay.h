// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Draws 2-D props into the overlay: text actors and scalar bars.
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

/// Draws the text actors and scalar bars of `renderer` into scene.OverlayImage. The camera of
/// `scene` must be set.
void ExtractOverlay(vtkRenderer* renderer, const ExtractionOptions& options, Scene& scene);

/// Returns true if ExtractOverlay() draws this prop.
bool IsOverlay(vtkProp* prop);

/// Returns the position of a coordinate in pixels.
glm::dvec2 ComputePixelPosition(vtkCoordinate* coordinate, const Scene& scene);

/// Draws text at `anchor` with the justification of `property`. Returns false if VTK cannot render
/// text.
bool DrawText(
  const std::string& text, vtkTextProperty* property, glm::dvec2 anchor, int dpi, Overlay& overlay);

}
#endif
