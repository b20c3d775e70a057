// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CornerGrid.h"

#include "Scene.h"

#include <algorithm>

namespace penumbra
{
CornerGrid::CornerGrid(glm::ivec2 low, glm::ivec2 high, bool allocate, bool penumbrae)
  : Low(low),
    High(high),
    FirstBlock(low / BlockSide),
    Blocks(high / BlockSide - low / BlockSide + 1),
    Corners(allocate ? static_cast<std::size_t>(high.x - low.x + 1) * (high.y - low.y + 1) : 0)
{
  if (penumbrae)
  {
    const glm::ivec2 last = high / BlockSide + 1;
    this->FirstBlock = glm::max(this->FirstBlock - 1, 0);
    this->Blocks = last - this->FirstBlock + 1;
    const std::size_t count = static_cast<std::size_t>(this->Blocks.x) * this->Blocks.y;
    this->LitBy.resize(count);
    this->ShadowedFrom.resize(count);
    this->Penumbrae.resize(count);
  }
  this->StripsPerRow = (this->Blocks.x + StripLength - 1) / StripLength;
}

template <typename Visit>
void CornerGrid::VisitStrip(int strip, const Visit& visit) const
{
  const int row = strip / this->StripsPerRow;
  const int first = strip % this->StripsPerRow * StripLength;
  for (int column = first; column < std::min(first + StripLength, this->Blocks.x); ++column)
  {
    visit(glm::ivec2(column, row));
  }
}

void CornerGrid::TraceStrip(
  const CameraRayTracer& tracer, int strip, bool packets, RayCounts& counts)
{
  this->VisitStrip(
    strip, [&](glm::ivec2 block) { this->TraceBlock(tracer, block, packets, 0, counts); });
}

void CornerGrid::TraceBlock(const CameraRayTracer& tracer, glm::ivec2 block, bool packets,
  std::uint32_t penumbrae, RayCounts& regionCounts)
{
  RayCounts counts;
  static_assert(BlockSide * BlockSide == CameraRayTracer::PacketSize, "one packet per block");
  const glm::ivec2 last(tracer.GetCamera().Width, tracer.GetCamera().Height);
  const glm::ivec2 first = (this->FirstBlock + block) * BlockSide;
  glm::dvec2 points[CameraRayTracer::PacketSize];
  Sample samples[CameraRayTracer::PacketSize];
  unsigned int active = 0;
  std::vector<PenumbraNeighbors> neighbors(penumbrae != 0 ? tracer.GetScene().Lights.size() : 0);
  std::vector<PenumbraNeighbors>* predictions = penumbrae != 0 ? &neighbors : nullptr;
  // Trace all corners of the block that lie in the whole image: packets must not depend on the
  // region.
  for (int i = 0; i < CameraRayTracer::PacketSize; ++i)
  {
    const glm::ivec2 p = first + glm::ivec2(i % BlockSide, i / BlockSide);
    points[i] = glm::dvec2(p);
    active |= (p.x <= last.x && p.y <= last.y ? 1u : 0u) << i;
  }
  do
  {
    for (PenumbraNeighbors& light : neighbors)
    {
      light.BeginNextPass();
    }
    if (packets && active != 0)
    {
      tracer.TracePacket(points, active, samples, counts, 1.0, penumbrae, predictions);
    }
    for (int i = 0; i < CameraRayTracer::PacketSize && !packets; ++i)
    {
      if (active >> i & 1u)
      {
        samples[i] = tracer.TraceSample(points[i], counts, 1.0, penumbrae, predictions);
      }
    }
  }
  while (std::any_of(neighbors.begin(), neighbors.end(),
    [](const PenumbraNeighbors& light) { return light.NeedsNextPass(); }));
  for (int i = 0; i < CameraRayTracer::PacketSize; ++i)
  {
    const glm::ivec2 p = first + glm::ivec2(i % BlockSide, i / BlockSide);
    if (!(active >> i & 1u))
    {
      continue;
    }
    if (penumbrae == 0)
    {
      ++counts.Primary;
      if (!this->LitBy.empty())
      {
        this->FlagsAt(block, this->LitBy) |= samples[i].LitBy;
        this->FlagsAt(block, this->ShadowedFrom) |= samples[i].ShadowedFrom;
      }
    }
    if (p.x >= this->Low.x && p.x <= this->High.x && p.y >= this->Low.y && p.y <= this->High.y)
    {
      this->Corners[this->Index(p.x, p.y)] = samples[i];
    }
  }
  const glm::ivec2 pixel = glm::min(first, last - 1);
  if (glm::all(glm::greaterThanEqual(pixel, this->CountedLow)) &&
    glm::all(glm::lessThan(pixel, this->CountedHigh)))
  {
    regionCounts += counts;
  }
  else
  {
    regionCounts.Repeated += counts.GetTotal();
  }
}

// Rays of 3 x 3 blocks are 144 samples of the light, so few penumbrae are missed, and those are
// nearly lit or nearly dark.
void CornerGrid::FindPenumbrae()
{
  for (int y = 0; y < this->Blocks.y && !this->LitBy.empty(); ++y)
  {
    for (int x = 0; x < this->Blocks.x; ++x)
    {
      std::uint32_t lit = 0;
      std::uint32_t shadowed = 0;
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, this->Blocks.y - 1); ++j)
      {
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, this->Blocks.x - 1); ++i)
        {
          lit |= this->FlagsAt({ i, j }, this->LitBy);
          shadowed |= this->FlagsAt({ i, j }, this->ShadowedFrom);
        }
      }
      this->FlagsAt({ x, y }, this->Penumbrae) = lit & shadowed;
    }
  }
}

void CornerGrid::ResolvePenumbrae(
  const CameraRayTracer& tracer, int strip, bool packets, RayCounts& counts)
{
  if (this->Penumbrae.empty())
  {
    return;
  }
  this->VisitStrip(strip, [&](glm::ivec2 block) {
    const std::uint32_t penumbrae = this->FlagsAt(block, this->Penumbrae);
    const glm::ivec2 first = (this->FirstBlock + block) * BlockSide;
    const bool isInside = first.x <= this->High.x && first.y <= this->High.y &&
      first.x + BlockSide > this->Low.x && first.y + BlockSide > this->Low.y;
    if (penumbrae != 0 && isInside)
    {
      this->TraceBlock(tracer, block, packets, penumbrae, counts);
    }
  });
}

std::uint32_t CornerGrid::GetPenumbrae(glm::dvec2 p) const
{
  if (this->Penumbrae.empty())
  {
    return 0;
  }
  std::uint32_t lights = 0;
  const glm::ivec2 pixel(glm::floor(p));
  for (int corner = 0; corner < 4; ++corner)
  {
    const glm::ivec2 at = pixel + glm::ivec2(corner & 1, corner >> 1);
    const glm::ivec2 block =
      glm::clamp(at / BlockSide - this->FirstBlock, glm::ivec2(0), this->Blocks - 1);
    lights |= this->Penumbrae[static_cast<std::size_t>(block.y) * this->Blocks.x + block.x];
  }
  return lights;
}

}
