// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The visible triangles of a scene as filled polygons, drawn from back to front. Hidden triangles are
// left out. Of two neighbors in the mesh, the first one extends below the second one, so that
// antialiasing leaves no seam between them, unless the camera cuts one.
#ifndef penumbra_VectorFaces_h
#define penumbra_VectorFaces_h

#include "Sampling/CameraRayTracer.h"
#include "VectorFigure.h"

#include <string>
#include <vector>

namespace penumbra
{

/**
 * Adds the background and the visible triangles to `paths`. Returns an empty string, or the reason
 * why paths cannot show the scene, in which case `paths` is left as it was: spheres, tubes,
 * splats, translucent surfaces, light shafts, an image as background, pixels of 2-D actors, more
 * than `maximum` paths, triangles without an order, or colors whose RMSE would exceed `tolerance`.
 */
std::string AddVisibleFaces(const CameraRayTracer& tracer, std::size_t maximum, double tolerance,
  std::vector<FigurePath>& paths);

}
#endif
