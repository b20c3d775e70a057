// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Draws 2-D props into the overlay: text, scalar bars, legends, axes and other annotations.
#ifndef penumbra_SceneExtractionOverlay_h
#define penumbra_SceneExtractionOverlay_h

#include <glm/glm.hpp>

#include <string>

class vtkCoordinate;
class vtkProp;
class vtkRenderer;
class vtkScalarBarActor;
class vtkTextProperty;

namespace penumbra
{

class Overlay;
struct Scene;

/// Draws the 2-D props of `renderer` into scene.OverlayImage, with a warning for each that is not
/// supported. The camera and the overlay of `scene` must be set.
void ExtractOverlay(vtkRenderer* renderer, int dpi, Scene& scene);

/// Returns true if ExtractOverlay() draws this prop or warns about it.
bool IsOverlay(vtkProp* prop);

/// Returns the position of a coordinate in pixels.
glm::dvec2 ComputePixelPosition(vtkCoordinate* coordinate, const Scene& scene);

/// Draws text at `anchor` with the justification of `property`. Returns false if VTK cannot render
/// text.
bool DrawText(
  const std::string& text, vtkTextProperty* property, glm::dvec2 anchor, int dpi, Overlay& overlay);

}
#endif
