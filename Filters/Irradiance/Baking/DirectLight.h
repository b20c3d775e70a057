// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Baking of direct light: the visible fraction of each light times the cosine, at all query points.
#ifndef penumbra_DirectLight_h
#define penumbra_DirectLight_h

#include "Baking.h"
#include "Light.h"

#include "Embree/RayScene.h"

#include <array>
#include <vector>

namespace penumbra
{

/// Lights of baking. They have the intensity 1 and no attenuation.
struct DirectLightSettings
{
  /// Homogeneous world positions; w = 0: the direction toward a directional light.
  std::vector<std::array<double, 4>> Positions;
  double Radius = 0.0; ///< of positional lights, which are spheres, in world units
  double Angle = 0.0;  ///< angular diameter of directional lights, in degrees
};

/// Converts lights to the coordinates of `scene`. Throws std::runtime_error if there are none, or
/// if a position or a size is invalid.
std::vector<Light> MakeLights(const DirectLightSettings& settings, const Scene& scene);

/**
 * Computes, at each site, the sum over the lights of the scene: visible fraction times the cosine
 * between the normal and the direction to the center of the light, 0 if that is behind the normal.
 * The standard error of each sum is at most `tolerance`. Returns false if `progress` requested a
 * stop.
 */
bool BakeDirectLight(const RayScene& rays, const std::vector<RecordCandidate>& sites,
  double tolerance, const ProgressCallback& progress, BakedValues& result);

}
#endif
