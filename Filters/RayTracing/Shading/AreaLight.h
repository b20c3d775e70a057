// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Lights with a size: shadow rays toward a sphere, a disk or the sun, and the fraction of the
// light that is visible from a point. The light is mapped to the unit disk. In a penumbra, the disk
// is usually divided by one smooth boundary. Its two ends are bisected along the circumference, and
// a probe between them measures its curvature, so that 20 rays are as accurate as 200 random ones.
// In images, the boundaries at neighboring pixels predict it, which halves the number of rays.
// Other penumbrae are sampled with a low-discrepancy sequence up to the tolerance.
#ifndef penumbra_AreaLight_h
#define penumbra_AreaLight_h

#include "Embree/RayScene.h"
#include "PenumbraNeighbors.h"
#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <cstdint>
#include <functional>

namespace penumbra
{

struct Light;

/// Maps the unit disk to shadow rays from a point to a light with a size. The density of the rays
/// is uniform in solid angle for spheres and suns, and uniform in area for the disks of spotlights.
class VTKPENUMBRAFILTERSRAYTRACING_EXPORT AreaLight
{
public:
  AreaLight(const Light& light, glm::vec3 point);

  /// Returns the ray from the point, with unit direction, to the part of the light at `disk`.
  Ray MakeRay(glm::vec2 disk) const;

  /// Returns true if the point is inside the sphere of the light, where all of it is visible.
  bool ContainsPoint() const { return this->Inside; }

private:
  const Light& Source;
  glm::vec3 Point;
  glm::vec3 Axis; ///< toward the center of the light
  glm::vec3 Tangents[2];
  float Distance = 0.f; ///< to the center
  float Cap = 0.f;      ///< 1 - cosine of the angular radius
  bool Inside = false;
};

/// Estimated fraction of a light that is visible, in [0, 1], and its standard error.
struct VisibleFraction
{
  float Value;
  float Error;
};

/// Estimates the mean of `visibility` over the unit disk. Stops when the estimated error is at most
/// `tolerance` or after 1024 samples. The boundary at `neighbors`, if given, predicts that at the
/// point, which is added to them.
VTKPENUMBRAFILTERSRAYTRACING_EXPORT VisibleFraction EstimateVisibleFraction(
  const std::function<float(glm::vec2)>& visibility, std::uint32_t seed, float tolerance,
  PenumbraNeighbors* neighbors = nullptr);

}
#endif
