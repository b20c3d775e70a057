// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Composites the renderers in layers above that of an image, such as orientation widgets.
#ifndef penumbra_LayerCompositing_h
#define penumbra_LayerCompositing_h

#include <vector>

class vtkImageData;
class vtkRenderer;

namespace penumbra
{

/// Pixels of an image that a layer covers.
struct LayerRectangle
{
  int Low[2];  ///< lower left pixel
  int Size[2]; ///< width and height in pixels; may be 0
};

/// Returns the renderers with visible props in layers above `renderer` in its window whose viewports
/// overlap, in order of their layers. `renderer` may be null.
std::vector<vtkRenderer*> FindLayersAbove(vtkRenderer* renderer);

/// Returns the pixels that the viewport of `layer` covers in an image of `resolution` pixels that
/// shows the viewport of `renderer`.
LayerRectangle FindLayerRectangle(
  vtkRenderer* renderer, vtkRenderer* layer, const int resolution[2]);

/// Composites the colors of `layer` over `image`, with its lower left corner at pixel `low`. Errors
/// are combined in proportion to the visible parts.
void CompositeOver(vtkImageData* layer, const int low[2], vtkImageData* image);

}
#endif
