// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Expands line segments and points to quads that face the camera and have an exact size in pixels.
#ifndef penumbra_LineExpansion_h
#define penumbra_LineExpansion_h

#include "DepthOffset.h"
#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

namespace penumbra
{

/// Quad with counterclockwise corners in the image. Corners 0 and 3 are at the start of the
/// segment. [Start, End] is the part of the segment in front of the camera, as parameters in [0,
/// 1].
struct Quad
{
  glm::dvec3 Corners[4];
  double Start = 0.0;
  double End = 1.0;
};

/// Shift of quads toward the camera, so that surfaces do not hide lines and points that lie on them.
struct QuadShift
{
  double Pixels = 0.0; ///< default, usually the line width
  DepthOffset Offset;  ///< replaces Pixels if it moves quads farther, or away from the camera
  double Slope = 0.0;  ///< minimum slope that Offset multiplies: that of a surface
};

/// Expands the segment from a to b to a quad that is `width` pixels wide along its whole length.
/// Returns false if the segment is behind the camera or projects to a point.
VTKPENUMBRAFILTERSSCENE_EXPORT bool ExpandLine(const Camera& camera, glm::dvec3 a, glm::dvec3 b,
  double width, const QuadShift& shift, Quad& quad);

/// Expands the point x to an axis-aligned square of `size` pixels. Returns false if the point is
/// behind the camera.
VTKPENUMBRAFILTERSSCENE_EXPORT bool ExpandPoint(
  const Camera& camera, glm::dvec3 x, double size, const QuadShift& shift, Quad& quad);

}
#endif
