// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What one look around a point tells: the mean over the hemisphere, and how it changes when the
// point moves or the normal tilts. The sum over boundaries between cells is Ward and Heckbert's
// (Irradiance Gradients, 1992); the idea to take the second derivative of the same boundaries for
// the error of a record is Schwarzhaupt, Jensen and Jarosz's (Practical Hessian-Based Error Control
// for Irradiance Caching, 2012). Derived here for any grid, see HemisphereEstimate.cxx.
#ifndef penumbra_HemisphereEstimate_h
#define penumbra_HemisphereEstimate_h

#include "Gatherer.h"
#include "HemisphereGrid.h"

#include <array>
#include <limits>
#include <vector>

namespace penumbra
{

/// Means are irradiance over pi: 1 under a sky of radiance 1. Lengths are those of the sights.
struct HemisphereEstimate
{
  glm::vec3 Mean{ 0.f };
  float Error = 0.f; ///< standard error of the mean, over the channels

  ///@{
  /// Per channel, in the tangent plane: change of the mean per unit of length that the point moves,
  /// and per unit that the tip of the normal moves.
  std::array<glm::vec3, 3> Translation{};
  std::array<glm::vec3, 3> Rotation{};
  ///@}

  float HessianNorm = 0.f; ///< largest second derivative along a line in the tangent plane

  /// Distance of the rims that make the mean change, near ones weighing more; closer to them than
  /// about half of it, derivatives are no longer those here.
  float OccluderEdgeDistance = std::numeric_limits<float>::infinity();

  float Nearest = std::numeric_limits<float>::infinity(); ///< hit, grazing directions left out
  float HarmonicMean = std::numeric_limits<float>::infinity();

  /// How far one can go along the tangent plane before a wall, by eighths of the turn about the
  /// normal that begin at the first tangent.
  static constexpr int Sectors = 8;
  std::array<float, Sectors> Clearance{};
};

/// The eighth of the turn that (x, y) lies in.
inline int SectorOf(float x, float y)
{
  const bool steep = std::abs(y) > std::abs(x);
  return (y < 0.f ? 4 : 0) + ((x < 0.f) != (y < 0.f) ? 2 : 0) +
    (steep != ((x < 0.f) != (y < 0.f)) ? 1 : 0);
}

/// Is what `cell` sees, as far as one can tell, part of a plane? A neighbour sees the same normal.
bool IsFlat(const HemisphereGrid& grid, const std::vector<HemisphereSample>& sights, int cell);

/// `directions` are those of `grid` in local coordinates, `sights` what they saw with normals in
/// scene coordinates, `frame` leads from local to scene coordinates. `falloff`: of the gatherer.
VTKPENUMBRAFILTERSIRRADIANCE_EXPORT HemisphereEstimate EstimateHemisphere(
  const HemisphereGrid& grid, const glm::mat3& frame, const std::vector<glm::vec3>& directions,
  const std::vector<HemisphereSample>& sights, const DistanceFalloff& falloff);

}
#endif
