// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The surface that a picture's depths show, pixel by pixel: where it is and which way it faces, in
// the coordinates of the ray scene. Where depths lie in a plane, are fine and those of the centres of pixels, they tell. Elsewhere a ray
// through the pixel's centre looks for the mesh close to its depth and takes place and normal from there;
// where it finds none (lines, points, what only the depth buffer knows) the neighbours' depths have to do.
#ifndef penumbra_SurfaceFromDepth_h
#define penumbra_SurfaceFromDepth_h

#include "Embree/RayScene.h"

#include <vector>

namespace penumbra
{

struct ScreenTransform;

struct SurfacePoint
{
  glm::vec3 Position{ 0.f }; ///< lifted off the surface, so that it does not block itself
  glm::vec3 Normal{ 0.f };   ///< unit, towards the eye; zero: an empty pixel
};

/// Which pixels of a picture are looked at: every Step-th in both directions.
struct InterleavedPixels
{
  int Step = 1;
  int Column = 0; ///< the first
  int Row = 0;

  bool operator==(const InterleavedPixels& other) const
  {
    return this->Step == other.Step && this->Column == other.Column && this->Row == other.Row;
  }

  /// How many there are among so many columns, or rows.
  int CountIn(int size, int first) const { return (size - first + this->Step - 1) / this->Step; }
};

/// `eyeDepths`: of the view, in its unit, row after row; `atCenters`: of the centres of pixels, not of one
/// of several samples somewhere in them. Only pixels of the
/// lattice are looked for and returned.
std::vector<SurfacePoint> ReconstructSurface(const std::vector<float>& eyeDepths, bool atCenters,
  const ScreenTransform& view, const RayScene& rays, const InterleavedPixels& lattice = {});

}
#endif
