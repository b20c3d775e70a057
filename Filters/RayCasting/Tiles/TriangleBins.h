// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The triangles of a scene that overlap each tile of the image.
#ifndef penumbra_TriangleBins_h
#define penumbra_TriangleBins_h

#include "Execution/ParallelBins.h"
#include "Sampling/PrimitiveId.h"
#include "TileGrid.h"
#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro, which tests need

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace penumbra
{

struct Scene;

/// Spheres, tubes and instances are not binned.
class VTKPENUMBRAFILTERSRAYCASTING_EXPORT TriangleBins
{
public:
  /// Bins the triangles into the tiles whose element of `selected` is not 0. All other tiles are
  /// empty.
  TriangleBins(const Scene& scene, const TileGrid& tiles, const std::vector<char>& selected);

  /// Returns the number of triangles of a tile: 0 if no tile was selected.
  std::size_t GetCount(int tile) const
  {
    return this->Triangles.GetNumberOfBins() == 0 ? 0 : this->Triangles.GetCount(tile);
  }
  const PrimitiveId* GetTriangles(int tile) const { return this->Triangles.Get(tile); }

  /// What decides which color samples of a surface show.
  enum class Visibility : char
  {
    Nearest,  ///< the nearest triangle, with one color
    Rays,     ///< rays: textures that do more than multiply the color
    Layers,   ///< all triangles: the surface is translucent or emits light
    Textured, ///< all triangles, because of a texture that multiplies the color
  };
  Visibility GetVisibility(std::uint32_t surface) const { return this->BySurface[surface]; }

private:
  std::vector<Visibility> BySurface; ///< empty if no tile is selected
  Bins<PrimitiveId> Triangles;
};

}
#endif
