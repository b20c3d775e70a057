// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Reconstructs the position and normal of the visible surface per pixel from a depth buffer, in
// scene coordinates. If the depths around a pixel are sampled at pixel centers, are precise and lie
// in a plane, they define position and normal. Otherwise a ray through the pixel center searches
// the meshes near that depth. If the ray misses (lines, points, geometry that only the depth buffer
// has), the neighboring depths are used.
#ifndef penumbra_SurfaceFromDepth_h
#define penumbra_SurfaceFromDepth_h

#include "Embree/RayScene.h"

#include <vector>

namespace penumbra
{

struct ScreenTransform;

struct SurfacePoint
{
  glm::vec3 Position{ 0.f }; ///< offset from the surface against self-intersection
  glm::vec3 Normal{ 0.f };   ///< unit vector toward the camera; zero: background
  float PixelSize = 0.f;     ///< side of a pixel at this depth
};

/// Fills the surface points of the pixels, row by row.
/// `eyeDepths`: eye depth per pixel in the unit of the view, row by row. `atCenters`: the depths
/// are sampled at pixel centers, not at one of several samples per pixel. `needed`: not 0 at the
/// pixels whose points are reconstructed, other points are undefined; null: all.
void ReconstructSurface(const std::vector<float>& eyeDepths, bool atCenters,
  const ScreenTransform& view, const RayScene& rays, const std::vector<char>* needed,
  std::vector<SurfacePoint>& points);

}
#endif
