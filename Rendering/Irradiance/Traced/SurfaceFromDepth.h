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

/// Lattice of the processed pixels of an image: every Step-th column and row.
struct InterleavedPixels
{
  int Step = 1;
  int Column = 0; ///< first column
  int Row = 0;    ///< first row

  bool operator==(const InterleavedPixels& other) const
  {
    return this->Step == other.Step && this->Column == other.Column && this->Row == other.Row;
  }

  /// Number of lattice columns (or rows) of an image of `size` columns (or rows), starting at
  /// `first`.
  int CountIn(int size, int first) const { return (size - first + this->Step - 1) / this->Step; }
};

/// Returns the surface points of the lattice, row by row.
/// `eyeDepths`: eye depth per pixel in the unit of the view, row by row. `atCenters`: the depths
/// are sampled at pixel centers, not at one of several samples per pixel.
std::vector<SurfacePoint> ReconstructSurface(const std::vector<float>& eyeDepths, bool atCenters,
  const ScreenTransform& view, const RayScene& rays, const InterleavedPixels& lattice = {});

}
#endif
