// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Plain data of a figure in vector graphics: faces, an image, lines and text, drawn in this order.
// Coordinates are in pixels with (0, 0) at the lower left corner.
#ifndef penumbra_VectorFigure_h
#define penumbra_VectorFigure_h

#include "Overlay.h"

#include <glm/glm.hpp>

#include <utility>
#include <vector>

namespace penumbra
{

/// A filled polygon, or a polyline with butt caps if Width is positive.
struct FigurePath
{
  std::vector<glm::dvec2> Points;
  /// Lower left corners and sizes of squares that belong to a counterclockwise polygon.
  std::vector<std::pair<glm::dvec2, glm::dvec2>> Squares;
  glm::vec4 Color{ 0.f, 0.f, 0.f, 1.f }; ///< straight alpha; at From if there is a gradient
  double Width = 0.0;                    ///< of a polyline, in pixels; 0: a filled polygon
  bool RoundCaps = false;                ///< of a polyline
  bool HasGradient = false; ///< of a polygon: linear from Color at From to EndColor at To
  glm::vec4 EndColor{ 0.f };
  glm::dvec2 From{ 0.0 };
  glm::dvec2 To{ 0.0 };

  /// Returns true if both are drawn with the same color, without a gradient, and pen.
  bool HasStyleOf(const FigurePath& other) const
  {
    return !this->HasGradient && !other.HasGradient && this->Color == other.Color &&
      this->Width == other.Width && this->RoundCaps == other.RoundCaps;
  }
};

struct VectorFigure
{
  int Width = 1;  ///< pixels
  int Height = 1; ///< pixels
  double PointsPerPixel = 1.0;
  std::vector<FigurePath> Faces;
  /// Image that covers the figure: 8-bit RGBA with straight alpha, top row first; may be empty.
  std::vector<glm::u8vec4> Image;
  std::vector<FigurePath> Lines;
  std::vector<OverlayShape> Shapes;
};

}
#endif
