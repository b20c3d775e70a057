// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Local linear regression for denoising: fits a function that is linear in position and normal to
// the noisy estimates around a point.
#ifndef penumbra_LocalRegression_h
#define penumbra_LocalRegression_h

#include "Records/RecordPlacement.h"

#include <array>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace penumbra
{

/// Mean over the hemisphere, one channel, and its standard error.
struct NoisyEstimate
{
  float Mean = 0.f;
  float Error = std::numeric_limits<float>::infinity();
};

class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT LocalRegression
{
public:
  /// Uses the points of `sites` with the indices `which`. `spacing` is the mean distance of
  /// neighboring points, `radius` is the radius of the neighborhood of a fit in spacings.
  LocalRegression(const std::vector<RecordCandidate>& sites, const std::vector<std::size_t>& which,
    float spacing, float radius);

  /// Returns the fitted value at point `index`. `estimates` has one estimate per point. The error
  /// includes noise and the residual of the fit; it is infinite if there are too few neighbors.
  NoisyEstimate Fit(std::size_t index, const std::vector<NoisyEstimate>& estimates) const;

private:
  /// Terms of the linear function: 1, two coordinates of the offset, two of the normal.
  static constexpr int Terms = 5;
  struct Row
  {
    std::array<double, Terms> Term;
    double Weight;
    NoisyEstimate Estimate;
  };

  void FindRows(
    std::size_t index, const std::vector<NoisyEstimate>& estimates, std::vector<Row>& rows) const;
  std::array<std::int64_t, 3> FindCell(glm::vec3 position) const;
  static std::uint64_t ComputeKey(const std::array<std::int64_t, 3>& cell);

  const std::vector<RecordCandidate>& Sites;
  float Radius; ///< radius of the neighborhood and side of a grid cell, scene units
  std::vector<std::size_t> Order; ///< indices of points, cell by cell
  std::unordered_map<std::uint64_t, std::pair<std::size_t, std::size_t>> Cells; ///< ranges of Order
};

}
#endif
