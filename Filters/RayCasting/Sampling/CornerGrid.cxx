// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CornerGrid.h"

namespace penumbra
{

CornerGrid::CornerGrid(glm::ivec2 low, glm::ivec2 high, bool allocate)
  : Low(low),
    High(high),
    FirstBlock(low / BlockSide),
    Blocks(high / BlockSide - low / BlockSide + 1),
    Samples(allocate ? static_cast<std::size_t>(high.x - low.x + 1) * (high.y - low.y + 1) : 0)
{
}

void CornerGrid::TraceRow(const CameraRayTracer& tracer, int row, bool packets, RayCounts& counts)
{
  static_assert(BlockSide * BlockSide == CameraRayTracer::PacketSize, "one packet per block");
  const glm::ivec2 last(tracer.GetScene().ViewCamera.Width, tracer.GetScene().ViewCamera.Height);
  for (int column = 0; column < this->Blocks.x; ++column)
  {
    const glm::ivec2 first = (this->FirstBlock + glm::ivec2(column, row)) * BlockSide;
    glm::dvec2 points[CameraRayTracer::PacketSize];
    Sample samples[CameraRayTracer::PacketSize];
    unsigned int active = 0;
    // Trace all corners of the block that lie in the whole image: packets must not depend on the
    // region.
    for (int i = 0; i < CameraRayTracer::PacketSize; ++i)
    {
      const glm::ivec2 p = first + glm::ivec2(i % BlockSide, i / BlockSide);
      points[i] = glm::dvec2(p);
      active |= (p.x <= last.x && p.y <= last.y ? 1u : 0u) << i;
    }
    if (packets)
    {
      tracer.TracePacket(points, active, samples, counts);
    }
    for (int i = 0; i < CameraRayTracer::PacketSize; ++i)
    {
      const glm::ivec2 p = first + glm::ivec2(i % BlockSide, i / BlockSide);
      if (!(active >> i & 1u))
      {
        continue;
      }
      if (!packets)
      {
        samples[i] = tracer.TraceSample(points[i], counts);
      }
      ++counts.Primary;
      if (p.x >= this->Low.x && p.x <= this->High.x && p.y >= this->Low.y && p.y <= this->High.y)
      {
        this->At(p.x, p.y) = samples[i];
      }
    }
  }
}

}
