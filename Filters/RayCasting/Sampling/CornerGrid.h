// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Samples at the pixel corners of an image region [AA]. Rays are traced in blocks of 4 x 4 corners,
// aligned to the whole image, so that the sample of a corner does not depend on the region.
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

  /// Allocates samples for the corners of the pixels [low, high), unless `allocate` is false.
  CornerGrid(glm::ivec2 low, glm::ivec2 high, bool allocate = true);

  /// Returns the number of rows of blocks.
  int GetNumberOfRows() const { return this->Blocks.y; }

  /// Traces one row of blocks. Different rows may be traced in parallel.
  void TraceRow(const CameraRayTracer& tracer, int row, bool packets, RayCounts& counts);

  /// Returns the sample at image point (x, y), for x in [low.x, high.x] and y in [low.y, high.y].
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
