// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Segments and points in space become quads that face the eye and have an exact size in pixels.
#ifndef penumbra_LineExpansion_h
#define penumbra_LineExpansion_h

#include "Camera.h"
#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

namespace penumbra
{

/// A quad, counter-clockwise as the eye sees it. A segment's corners 0 and 3 lie at its start, and
/// Start and End say which part of the segment is in front of the eye (0 to 1).
struct Quad
{
  glm::dvec3 Corners[4];
  double Start = 0.0;
  double End = 1.0;
};

/// `width` pixels wide everywhere, also where perspective shortens it, and as long as the segment.
/// It lies nearer to the eye than the segment by its own width, so that lines drawn on a surface
/// are not buried in it. False where nothing of it is in front of the eye, or where it is seen
/// from its end.
VTKPENUMBRAFILTERSSCENE_EXPORT bool ExpandLine(
  const Camera& camera, glm::dvec3 a, glm::dvec3 b, double width, Quad& quad);

/// A square of `size` pixels, with sides along those of the picture; pulled nearer as segments are.
VTKPENUMBRAFILTERSSCENE_EXPORT bool ExpandPoint(
  const Camera& camera, glm::dvec3 x, double size, Quad& quad);

}
#endif
