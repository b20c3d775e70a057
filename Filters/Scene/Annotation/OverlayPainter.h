// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Fills polygons, lines and textured triangles in an overlay. A pixel is filled if its center is
// inside, as OpenGL does without antialiasing.
#ifndef penumbra_OverlayPainter_h
#define penumbra_OverlayPainter_h

#include "Material.h"
#include "Overlay.h"

#include <glm/glm.hpp>

#include <vector>

class vtkUnsignedCharArray;

namespace penumbra
{

/// Converts an image of 1 to 4 components (luminance, luminance and alpha, RGB, RGBA), bottom row first. Its texels
/// are empty if there are too few.
Texture ConvertTexels(vtkUnsignedCharArray* colors, int width, int height);

/// Corner of a triangle.
struct OverlayVertex
{
  glm::dvec2 Position;
  glm::vec4 Color{ 1.f };
  glm::dvec2 Coordinates{ 0.0 }; ///< in the texture
};

/// Fills a polygon with straight edges, which may be concave.
void FillPolygon(const std::vector<glm::dvec2>& corners, glm::vec4 color, Overlay& overlay);

/// Fills a line as a rectangle that exceeds the ends by half the width.
void FillLine(glm::dvec2 from, glm::dvec2 to, double width, glm::vec4 color, Overlay& overlay);

/// Fills a convex polygon with interpolated colors, multiplied by `texels` unless that is null.
/// `isDescribed` is true if shapes of the overlay describe its pixels, as those of text.
void FillShadedPolygon(const std::vector<OverlayVertex>& corners, const Texture* texels,
  Overlay& overlay, bool isDescribed = false);

}
#endif
