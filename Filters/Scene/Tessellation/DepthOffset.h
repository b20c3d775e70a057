// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Offsets of depths that decide which of coincident surfaces is visible, as glPolygonOffset() and
// vtkMapper do. Points move along their view ray, so their image coordinates do not change.
#ifndef penumbra_DepthOffset_h
#define penumbra_DepthOffset_h

#include "Camera.h"
#include "vtkPenumbraFiltersSceneModule.h" // for export macro, which tests need

namespace penumbra
{

struct Surface;

/// Offset of the depths of primitives, see vtkMapper. Positive offsets are away from the camera.
struct DepthOffset
{
  double Factor = 0.0; ///< of the depth that a primitive traverses per pixel of the image
  double Units = 0.0;  ///< in multiples of Camera::DepthUnit

  bool IsZero() const { return this->Factor == 0.0 && this->Units == 0.0; }
  /// Returns a value that is smaller for offsets that are nearer to the camera.
  double GetRank() const { return this->Factor + this->Units; }
};

inline DepthOffset operator-(const DepthOffset& a, const DepthOffset& b)
{
  return { a.Factor - b.Factor, a.Units - b.Units };
}

inline bool operator==(const DepthOffset& a, const DepthOffset& b)
{
  return a.Factor == b.Factor && a.Units == b.Units;
}

/// Maximum slope of polygons that a factor multiplies, reached at 83 degrees from the view axis. It
/// bounds the distance by which silhouettes of curved surfaces move along the view axis.
constexpr double MaximumPolygonSlope = 8.0;

/// Returns the side length of a pixel at the depth of x, in scene units.
double ComputePixelSize(const Camera& camera, glm::dvec3 x);

/// Returns the depth that a plane with the normal n through x traverses per pixel, in pixels.
double ComputeSlopeOfPlane(const Camera& camera, glm::dvec3 x, glm::dvec3 n);

/// Returns the distance by which `offset` moves x toward the camera, in multiples of the size of a
/// pixel at x. `slope` is the depth that the primitive traverses per pixel, in the same unit.
double ComputeShift(const Camera& camera, glm::dvec3 x, DepthOffset offset, double slope);

/// Returns the depth that the segment from a to b traverses per pixel, in pixels.
double ComputeSlope(const Camera& camera, glm::dvec3 a, glm::dvec3 b);

/// Moves the vertices of a surface of triangles by `offset`, at least as far as rounding requires to
/// separate the surface from a copy in its place. The shading of the surface does not change.
VTKPENUMBRAFILTERSSCENE_EXPORT void OffsetSurface(
  const Camera& camera, DepthOffset offset, Surface& surface);

}
#endif
