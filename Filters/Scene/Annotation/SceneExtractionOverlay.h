// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Draws 2-D props into the overlay: text, scalar bars, legends, axes and other annotations.
#ifndef penumbra_SceneExtractionOverlay_h
#define penumbra_SceneExtractionOverlay_h

#include "VisiblePoints.h"

#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <string>

class vtkCoordinate;
class vtkImageData;
class vtkProp;
class vtkRenderer;
class vtkTextProperty;
class vtkTextRenderer;

namespace penumbra
{

class Overlay;
struct Scene;

/// Draws the 2-D props of `renderer` into scene.OverlayImage, with a warning for each that is not
/// supported. The camera, the surfaces and the overlay of `scene` must be set. `findDepths` finds the
/// visible points of labels.
void ExtractOverlay(vtkRenderer* renderer, int dpi, const DepthQuery& findDepths, Scene& scene);

/// Returns true if ExtractOverlay() draws this prop or warns about it.
bool IsOverlay(vtkProp* prop);

/// Returns the position of a coordinate in pixels.
glm::dvec2 ComputePixelPosition(vtkCoordinate* coordinate, const Scene& scene);

/// Adds shapes of the background of text and of its lines, whose pixels are drawn by others.
void AddTextShapes(const std::string& text, vtkTextProperty* property, glm::dvec2 anchor, int dpi,
  vtkTextRenderer* renderer, Overlay& overlay);

/// Renders text. Returns null if it is empty or VTK cannot render text. `corner` receives the pixel
/// of the lower left corner relative to the anchor.
vtkSmartPointer<vtkImageData> RenderText(
  const char* text, vtkTextProperty* property, int dpi, glm::ivec2& corner);

/// Draws text at `anchor` with the justification of `property`. Returns false if VTK cannot render
/// text.
bool DrawText(
  const std::string& text, vtkTextProperty* property, glm::dvec2 anchor, int dpi, Overlay& overlay);

}
#endif
