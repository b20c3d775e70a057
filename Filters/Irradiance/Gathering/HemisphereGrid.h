// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Stratification of the hemisphere about +z into side x side cells of equal cosine-weighted solid
// angle, with precomputed corners and derivatives.
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
  static constexpr int Step = 4; ///< sides are multiples of this, to fill packets of 4 x 4 rays
  static constexpr int MinimumSide = 8;
  static constexpr int MaximumSide = 256;

  int Side = 0;
  std::vector<glm::vec3> Corners; ///< (Side + 1)^2, row by row
  /// Derivative of the cosine-weighted solid angle of each cell, over pi, with respect to the
  /// normal: 1/pi times the integral of the tangential part of the direction over solid angle.
  std::vector<glm::vec2> NormalDerivatives;

  int Cells() const { return this->Side * this->Side; }
  glm::vec3 Corner(int i, int j) const { return this->Corners[j * (this->Side + 1) + i]; }

  /// Fills `directions` with one jittered direction per cell.
  void JitterDirections(std::uint32_t seed, std::vector<glm::vec3>& directions) const;

  /// Appends `subdivisions` x `subdivisions` jittered directions of one cell to `directions`.
  void SubsampleCell(
    int cell, int subdivisions, std::uint32_t& random, std::vector<glm::vec3>& directions) const;

  /// Returns the cell that contains `direction`; -1 below the horizon.
  int FindCell(glm::vec3 direction) const;

  /// Returns the shared grid of `side`, which must be in [MinimumSide, MaximumSide].
  VTKPENUMBRAFILTERSIRRADIANCE_EXPORT static const HemisphereGrid& Get(int side);
};

}
#endif
