// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Finds which parts of joined estimates depend on the sites of changed tiles.
#ifndef penumbra_ChangedBlocks_h
#define penumbra_ChangedBlocks_h

#include "LightConstants.h"
#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro

#include <glm/glm.hpp>

#include <vector>

namespace penumbra
{

/// Blocks are numbered row by row in the whole grid, and listed tile by tile.
class VTKPENUMBRAFILTERSRAYCASTING_EXPORT ChangedBlocks
{
public:
  /// `tiles`: numbers of tiles on both axes. `changed`: indices of the tiles whose sites have changed.
  ChangedBlocks(glm::ivec2 tiles, const std::vector<int>& changed);

  /// Block of BiasLevel with estimates that change, and the levels, as bits, whose models change in it.
  struct Estimates
  {
    int Block;
    unsigned int Levels;
  };

  std::vector<int>
    Models[LightLevels]; ///< blocks of each level whose windows contain changed sites
  std::vector<Estimates> Evaluated;
  std::vector<int> Biased;   ///< blocks of BiasLevel whose bias depends on these estimates
  std::vector<int> Combined; ///< blocks of BiasLevel with estimates that depend on this bias
  std::vector<int> Tiles;    ///< that contain combined blocks

private:
  using Flags = std::vector<char>;

  /// Returns true if a tile that overlaps the cells [low, high) has changed.
  bool HasChanges(glm::ivec2 low, glm::ivec2 high) const;
  unsigned int FindLevels(glm::ivec2 block) const;
  void FindModels(const Flags& near);
  void FindEstimates(const Flags& near);
  void FindBias();
  /// Returns the indices of blocks with a flag in [0, `size`), tile by tile. `ratio`: of the sides of tile and block.
  static std::vector<int> List(const Flags& flags, glm::ivec2 size, int ratio);

  glm::ivec2 Size; ///< in tiles
  Flags Changed;   ///< of tiles
};

}
#endif
