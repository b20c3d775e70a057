// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The samples at the corners of the pixels of a picture's part [AA]. Rays go in blocks of 4 x 4
// corners that are aligned to the whole picture, so that a corner's result never depends on which
// part is asked for.
#ifndef penumbra_CornerGrid_h
#define penumbra_CornerGrid_h

#include "CameraRayTracer.h"

#include <vector>

namespace penumbra
{

class CornerGrid
{
public:
  static constexpr int BlockSide = 4;

  /// Room for the corners of the pixels [low, high), or for none; nothing is traced yet.
  CornerGrid(glm::ivec2 low, glm::ivec2 high, bool allocate = true);

  /// Rows of blocks.
  int GetNumberOfRows() const { return this->Blocks.y; }

  /// Traces one row of blocks; rows are independent of each other.
  void TraceRow(const CameraRayTracer& sampler, int row, bool packets, RayCounts& counts);

  /// The sample at picture point (x, y), low.x <= x <= high.x and likewise for y.
  const Sample& At(int x, int y) const { return this->Samples[this->Index(x, y)]; }
  Sample& At(int x, int y) { return this->Samples[this->Index(x, y)]; }

  glm::ivec2 GetLow() const { return this->Low; }
  glm::ivec2 GetHigh() const { return this->High; }

private:
  std::size_t Index(int x, int y) const
  {
    return static_cast<std::size_t>(y - this->Low.y) * (this->High.x - this->Low.x + 1) +
      (x - this->Low.x);
  }

  glm::ivec2 Low, High;
  glm::ivec2 FirstBlock, Blocks;
  std::vector<Sample> Samples;
};

}
#endif
