// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The hemisphere about +z cut into side x side cells of equal weight under the cosine, and what of
// them never changes.
#ifndef penumbra_HemisphereGrid_h
#define penumbra_HemisphereGrid_h

#include "vtkPenumbraFiltersIrradianceModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace penumbra
{

struct HemisphereGrid
{
  static constexpr int Step = 4; ///< sides are multiples of it, so that rays go in packets of 4 x 4
  static constexpr int LeastSide = 8;
  static constexpr int MostSide = 256;

  int Side = 0;
  std::vector<glm::vec3> Corners; ///< (Side + 1)^2, row by row
  /// Per cell, 1/pi times the integral of the direction's tangential part over solid angle: how the
  /// share of the cell changes as the normal tilts.
  std::vector<glm::vec2> NormalDerivatives;

  int Cells() const { return this->Side * this->Side; }
  glm::vec3 Corner(int i, int j) const { return this->Corners[j * (this->Side + 1) + i]; }

  /// One direction a cell, jittered by `seed`.
  void JitterDirections(std::uint32_t seed, std::vector<glm::vec3>& directions) const;

  /// `finer` * `finer` directions of one cell, appended to `directions`.
  void SubsampleCell(
    int cell, int finer, std::uint32_t& random, std::vector<glm::vec3>& directions) const;

  /// The grid of `side`, made once.
  VTKPENUMBRAFILTERSIRRADIANCE_EXPORT static const HemisphereGrid& Get(int side);
};

}
#endif
