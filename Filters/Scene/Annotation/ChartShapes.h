// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Polygons of what a context device of VTK draws: dashes, markers, arcs and clipped polygons.
#ifndef penumbra_ChartShapes_h
#define penumbra_ChartShapes_h

#include "OverlayPainter.h"

#include <vector>

namespace penumbra
{

/// Returns the part of a polygon in a rectangle.
std::vector<OverlayVertex> Clip(
  std::vector<OverlayVertex> corners, glm::dvec2 low, glm::dvec2 high);

/// Maps a texture to the rectangle around a polygon. VTK replaces the color of the brush by it.
void StretchTexture(std::vector<OverlayVertex>& corners);

/// Returns the points of a part of an ellipse, between angles in degrees.
std::vector<glm::dvec2> MakeEllipticArc(
  glm::dvec2 center, glm::dvec2 radii, double startAngle, double stopAngle);

/// Returns the polygons of a marker of vtkContext2D::DrawMarkers(). `half` is half its width.
std::vector<std::vector<OverlayVertex>> MakeMarker(
  int shape, glm::dvec2 center, double half, double thickness, glm::vec4 color);

/// Returns the dashes of a line of a type of vtkPen, whose stipples are `unit` pixels long. The line
/// continues one of `length` pixels, which is increased.
std::vector<std::vector<OverlayVertex>> MakeDashes(glm::dvec2 from, glm::dvec2 to, double width,
  int type, double unit, glm::vec4 color, double& length);

}
#endif
