// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Mean over the hemisphere of a point, with its gradients with respect to position and normal. The
// sum over boundaries between cells is due to Ward and Heckbert (Irradiance Gradients, 1992). The
// use of the second derivative of the same boundaries for the error of a record is due to
// Schwarzhaupt, Jensen and Jarosz (Practical Hessian-Based Error Control for Irradiance Caching,
// 2012). HemisphereEstimate.cxx derives both for arbitrary grids.
#ifndef penumbra_HemisphereEstimate_h
#define penumbra_HemisphereEstimate_h

#include "Gatherer.h"
#include "HemisphereGrid.h"

#include <array>
#include <limits>
#include <vector>

namespace penumbra
{

/// Estimate from hemisphere samples. Means are irradiance over pi: 1 under a sky of radiance 1.
/// Lengths have the unit of the sample distances.
struct HemisphereEstimate
{
  glm::vec3 Mean{ 0.f };
  float Error = 0.f; ///< standard error of the mean, of the channel with the largest error

  ///@{
  /// Gradients of the mean per channel, in the tangent plane, with respect to the position and to
  /// the normal.
  std::array<glm::vec3, 3> Translation{};
  std::array<glm::vec3, 3> Rotation{};
  ///@}

  /// Maximum second derivative along a line in the tangent plane, of all channels.
  float HessianNorm = 0.f;

  /// Mean distance of the occluder edges that contribute to the gradient, with more weight on near
  /// edges. The derivatives are valid up to about half of this distance.
  float OccluderEdgeDistance = std::numeric_limits<float>::infinity();

  float Nearest = std::numeric_limits<float>::infinity(); ///< hit distance, without grazing rays
  float HarmonicMean = std::numeric_limits<float>::infinity();

  /// Distance to the nearest wall along the tangent plane, for each 45-degree sector about the
  /// normal, starting at the first tangent.
  static constexpr int Sectors = 8;
  std::array<float, Sectors> Clearance{};
};

/// Returns the index of the 45-degree sector that contains (x, y).
inline int SectorOf(float x, float y)
{
  const bool steep = std::abs(y) > std::abs(x);
  return (y < 0.f ? 4 : 0) + ((x < 0.f) != (y < 0.f) ? 2 : 0) +
    (steep != ((x < 0.f) != (y < 0.f)) ? 1 : 0);
}

/// Returns true if the surface in `cell` appears planar: a neighboring cell has the same normal.
bool IsFlat(const HemisphereGrid& grid, const std::vector<HemisphereSample>& samples, int cell);

/// Computes the estimate from `samples`, sampled along `directions` (local coordinates, one per
/// cell of `grid`). Normals of samples are in scene coordinates. `frame` transforms local to scene
/// coordinates. `falloff` is the falloff of the gatherer.
VTKPENUMBRAFILTERSIRRADIANCE_EXPORT HemisphereEstimate EstimateHemisphere(
  const HemisphereGrid& grid, const glm::mat3& frame, const std::vector<glm::vec3>& directions,
  const std::vector<HemisphereSample>& samples, const DistanceFalloff& falloff);

}
#endif
