// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The triangles of a scene that overlap each tile of the image.
#ifndef penumbra_TriangleBins_h
#define penumbra_TriangleBins_h

#include "Sampling/PrimitiveId.h"
#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace penumbra
{

struct Scene;

/// Tiles with the same side, row by row from `Origin`, the lower left corner of the first one.
struct TileGrid
{
  glm::dvec2 Origin;
  int Side;
  glm::ivec2 Count;
};

/// Spheres, tubes and instances are not binned.
class VTKPENUMBRAFILTERSRAYCASTING_EXPORT TriangleBins
{
public:
  /// Bins the triangles into the tiles whose element of `selected` is not 0. All other tiles are
  /// empty.
  TriangleBins(const Scene& scene, const TileGrid& tiles, const std::vector<char>& selected);

  std::size_t GetCount(int tile) const { return this->Begin[tile + 1] - this->Begin[tile]; }
  const PrimitiveId* GetTriangles(int tile) const
  {
    return this->Triangles.data() + this->Begin[tile];
  }

  /// Returns true if samples of a surface may show something else than one color per triangle, so
  /// that rays are required: translucent and textured surfaces.
  bool IsComplex(std::uint32_t surface) const { return this->Complex[surface] != 0; }

  /// Returns true if that is so because the surface is translucent or emits light; layers decide.
  bool IsLayer(std::uint32_t surface) const { return this->Complex[surface] == 2; }

  /// Returns true if that is so only because of a texture that multiplies colors; layers decide.
  bool IsTextured(std::uint32_t surface) const { return this->Complex[surface] == 3; }

private:
  std::vector<char>
    Complex; ///< per surface, 2: IsLayer(), 3: IsTextured(); empty if no tile is selected
  std::vector<std::size_t> Begin; ///< first triangle of each tile, and the end
  std::vector<PrimitiveId> Triangles;
};

}
#endif
