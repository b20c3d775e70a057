// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What baking asks of the other ranks of a parallel program, each of which has a part of the surfaces and
// computes the values on it. Filters/Parallel implements it.
#ifndef penumbra_OccluderDistribution_h
#define penumbra_OccluderDistribution_h

#include "Execution/RankAgreement.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace penumbra
{

struct Scene;

class OccluderDistribution
{
public:
  virtual ~OccluderDistribution() = default;

  /// Returns what the ranks find out together for any purpose.
  virtual RankAgreement& GetRanks() = 0;

  /// Adds the primitives of other ranks that rays from query points may meet, at `points` and in the polygons of
  /// the first surface of the scene, which remains the first one. Surfaces of the same object and appearance become
  /// one, in the order of the ranks. `radius`: maximum length of the rays, in scene units, may be infinite; without
  /// it, they end at the lights of the scene. Returns the index that the first position of the first surface has
  /// afterwards. Collective.
  virtual std::uint32_t Exchange(
    Scene& scene, const std::vector<glm::vec3>& points, std::optional<double> radius) = 0;
};

}
#endif
