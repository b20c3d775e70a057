// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Image of 2-D props, such as text and scalar bars, which is composited over the rendered image.
// Rectangles are drawn with exact pixel coverage.
#ifndef penumbra_Overlay_h
#define penumbra_Overlay_h

#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <vector>

class vtkImageData;

namespace penumbra
{

/// RGBA image that is composited over the rendered image.
class VTKPENUMBRAFILTERSSCENE_EXPORT Overlay
{
public:
  Overlay() = default;
  Overlay(int width, int height);

  bool IsEmpty() const { return this->Pixels.empty(); }
  int GetWidth() const { return this->Width; }
  int GetHeight() const { return this->Height; }

  /// Fills the rectangle [low, high] with `color` (straight alpha). Coordinates are in pixels with
  /// (0, 0) at the lower left corner of the image.
  void FillRectangle(glm::dvec2 low, glm::dvec2 high, glm::vec4 color);

  /// Draws an 8-bit RGBA image with its lower left corner at pixel (x, y). Other formats are
  /// ignored.
  void DrawImage(vtkImageData* image, int x, int y);

  /// Composites the overlay's pixels (x, y) to (x + count - 1, y) over `colors` (straight alpha).
  void CompositeOver(int x, int y, int count, glm::vec4* colors) const;

private:
  void Blend(int x, int y, glm::vec4 color);

  int Width = 0;
  int Height = 0;
  std::vector<glm::vec4> Pixels; ///< premultiplied alpha; empty until something is drawn
};

}
#endif
