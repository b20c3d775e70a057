// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What lies over a picture: text and colour legends, drawn in pixels with exact coverage of
// rectangles.
#ifndef penumbra_Overlay_h
#define penumbra_Overlay_h

#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <vector>

class vtkImageData;

namespace penumbra
{

class VTKPENUMBRAFILTERSSCENE_EXPORT Overlay
{
public:
  Overlay() = default;
  Overlay(int width, int height);

  bool IsEmpty() const { return this->Pixels.empty(); }
  int GetWidth() const { return this->Width; }
  int GetHeight() const { return this->Height; }

  /// Draws [low, high] (in pixels, (0, 0) the picture's lower left corner) in a straight colour.
  void FillRectangle(glm::dvec2 low, glm::dvec2 high, glm::vec4 color);

  /// Draws an RGBA image of 8 bits with its lower left corner at pixel (x, y).
  void DrawImage(vtkImageData* image, int x, int y);

  /// Puts pixels (x, y) to (x + count - 1, y) of the overlay over `colors` (straight alpha).
  void CompositeOver(int x, int y, int count, glm::vec4* colors) const;

private:
  void Blend(int x, int y, glm::vec4 color);

  int Width = 0;
  int Height = 0;
  std::vector<glm::vec4> Pixels; ///< premultiplied; none before something is drawn
};

}
#endif
