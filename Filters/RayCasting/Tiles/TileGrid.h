// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The tiles of an image region, the units of work of threads.
#ifndef penumbra_TileGrid_h
#define penumbra_TileGrid_h

#include <glm/glm.hpp>

namespace penumbra
{

/// Tiles with the same side in pixels, row by row from `Origin`, the lower left corner of the first one.
struct TileGrid
{
  glm::dvec2 Origin;
  int Side;
  glm::ivec2 Count;
};

}
#endif
