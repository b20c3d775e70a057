// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Expands line segments and points to quads that face the camera and have an exact size in pixels.
#ifndef penumbra_LineExpansion_h
#define penumbra_LineExpansion_h

#include "Camera.h"
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

/// Expands the segment from a to b to a quad that is `width` pixels wide along its whole length.
/// The quad is offset toward the camera by the line width, so that surfaces do not hide lines that
/// lie on them. Returns false if the segment is behind the camera or projects to a point.
VTKPENUMBRAFILTERSSCENE_EXPORT bool ExpandLine(
  const Camera& camera, glm::dvec3 a, glm::dvec3 b, double width, Quad& quad);

/// Expands the point x to an axis-aligned square of `size` pixels, moved by `offset` pixels toward
/// the camera as lines are. Returns false if the point is behind the camera.
VTKPENUMBRAFILTERSSCENE_EXPORT bool ExpandPoint(
  const Camera& camera, glm::dvec3 x, double size, double offset, Quad& quad);

}
#endif
