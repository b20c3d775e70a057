// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// An origin of scene coordinates that depends on the bounds of the scene but not on the camera, so
// that the triangles and their BVH can be kept while the camera moves. Rounding errors of
// coordinates are proportional to the distance from the origin. This origin is therefore used only
// if the distance of the camera is similar.
#ifndef penumbra_FixedOrigin_h
#define penumbra_FixedOrigin_h

#include "Camera.h"

#include <glm/glm.hpp>

#include <limits>

namespace penumbra
{

/// Distance of the origin from the center of the bounds, in radii of the bounding sphere. No point
/// of the scene is close to the origin, because the offsets of secondary rays and the depth
/// tolerance of coincident surfaces are proportional to coordinates.
constexpr double FixedOriginDistance = 2.0;

/// Maximum distance of the camera from the center of the bounds, in radii. The errors of distances
/// along camera rays are proportional to it.
constexpr double MaximumEyeDistance = 8.0;

/// Maximum ratio of the largest coordinate to the distance between camera and bounds. Errors that
/// are proportional to coordinates grow by this factor relative to an origin at the camera.
constexpr double MaximumCoordinateRatio = 8.0;

/// Maximum displacement of a vertex in the image by the rounding of its coordinates, in pixels. It
/// changes the color of a pixel by half a level of 1/255 at most.
constexpr double MaximumVertexShift = 1.0 / 510.0;

/// Bounding sphere of the bounds of a scene, in world coordinates.
struct BoundingSphere
{
  glm::dvec3 Center;
  double Radius;

  BoundingSphere(glm::dvec3 low, glm::dvec3 high)
    : Center(0.5 * low + 0.5 * high),
      Radius(0.5 * glm::length(high - low))
  {
  }

  /// Returns the origin of scene coordinates, in the direction (-1, -1, -1) from the center.
  glm::dvec3 FindFixedOrigin() const
  {
    return this->Center - FixedOriginDistance * this->Radius * glm::normalize(glm::dvec3(1.0));
  }
};

/// Returns true if the fixed origin for the bounds [low, high] is precise enough for `camera` at
/// `position` (world coordinates; in parallel projection, of the ray origins).
/// camera.PixelSize is in world units in parallel projection.
inline bool IsFixedOriginPrecise(
  const Camera& camera, glm::dvec3 position, glm::dvec3 low, glm::dvec3 high)
{
  const BoundingSphere sphere(low, high);
  const double largest = (FixedOriginDistance + 1.0) * sphere.Radius;
  // The comparisons are false for NaN.
  if (!(sphere.Radius > 0.0 &&
        glm::length(position - sphere.Center) <= MaximumEyeDistance * sphere.Radius))
  {
    return false;
  }
  const glm::dvec3 gap = glm::max(glm::max(low - position, position - high), glm::dvec3(0.0));
  const double distance = camera.Parallel ? 1.0 : glm::length(gap);
  const double rounding = 0.5 * std::numeric_limits<float>::epsilon() * largest;
  return (camera.Parallel || largest <= MaximumCoordinateRatio * distance) &&
    rounding <= MaximumVertexShift * camera.PixelSize * distance;
}

}
#endif
