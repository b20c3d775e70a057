// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Composites the renderers in layers above and below that of an image, such as orientation widgets
// and backgrounds.
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

/// Returns the renderers with visible props in layers above `renderer` in its window whose
/// viewports overlap, in order of their layers. `renderer` may be null.
std::vector<vtkRenderer*> FindLayersAbove(vtkRenderer* renderer);

/// Returns the renderers in layers below `renderer` in its window whose viewports overlap, the
/// nearest layer first. Empty if `renderer` erases them. `renderer` may be null.
std::vector<vtkRenderer*> FindLayersBelow(vtkRenderer* renderer);

/// Returns the pixels that the viewport of `layer` covers in an image of `resolution` pixels that
/// shows the viewport of `renderer`.
LayerRectangle FindLayerRectangle(
  vtkRenderer* renderer, vtkRenderer* layer, const int resolution[2]);

/// Composites the colors of `layer` with `image`, with its lower left corner at pixel `low`. Errors
/// are combined in proportion to the visible parts.
/// @param isAbove If true, `layer` covers `image`; if false, it is covered.
void CompositeLayer(vtkImageData* layer, const int low[2], bool isAbove, vtkImageData* image);

}
#endif
