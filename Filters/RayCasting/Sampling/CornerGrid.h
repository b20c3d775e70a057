// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Samples at the pixel corners of an image region [AA]. Rays are traced in blocks of 4 x 4 corners,
// aligned to the whole image, so that the sample of a corner does not depend on the region. Blocks
// in the penumbra of a light with a size are traced again with the visible fraction of the light.
#ifndef penumbra_CornerGrid_h
#define penumbra_CornerGrid_h

#include "CameraRayTracer.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace penumbra
{

class CornerGrid
{
public:
  static constexpr int BlockSide = 4;

  /// Allocates samples for the corners of the pixels [low, high), unless `allocate` is false.
  /// With `penumbrae`, a margin of one block is traced as well.
  CornerGrid(glm::ivec2 low, glm::ivec2 high, bool allocate = true, bool penumbrae = false);

  /// Counts the rays of blocks outside the pixels [low, high) as RayCounts::Repeated. The corners at the
  /// right and upper side of the whole image belong to its last pixels.
  void SetCountedPixels(glm::ivec2 low, glm::ivec2 high)
  {
    this->CountedLow = low;
    this->CountedHigh = high;
  }

  /// Returns the number of strips: StripLength consecutive blocks of a row, or its rest.
  int GetNumberOfStrips() const { return this->StripsPerRow * this->Blocks.y; }

  /// Returns the strip of the corner (x, y).
  int GetStrip(int x, int y) const
  {
    const glm::ivec2 block = glm::ivec2(x, y) / BlockSide - this->FirstBlock;
    return block.y * this->StripsPerRow + block.x / StripLength;
  }

  /// Traces one strip of blocks. Different strips may be traced in parallel.
  void TraceStrip(const CameraRayTracer& tracer, int strip, bool packets, RayCounts& counts);

  /// Finds the blocks in the penumbra of a light with a size: rays to the light disagree in the
  /// block or in one of its neighbors. Call it when all strips have been traced.
  void FindPenumbrae();

  /// Traces the blocks of one strip that are in a penumbra again and estimates the visible fractions
  /// of the lights. Different strips may be traced in parallel.
  void ResolvePenumbrae(const CameraRayTracer& tracer, int strip, bool packets, RayCounts& counts);

  /// Returns the lights that cast a penumbra on the pixel that contains `p`.
  std::uint32_t GetPenumbrae(glm::dvec2 p) const;

  /// Returns the sample at image point (x, y), for x in [low.x, high.x] and y in [low.y, high.y].
  /// It lacks the lights that rays reached, and what continues the ray behind its first hit.
  Sample At(int x, int y) const
  {
    Sample sample;
    this->Load(x, y, sample);
    return sample;
  }
  /// Stores what At() returns in `sample`.
  void Load(int x, int y, Sample& sample) const { this->Corners[this->Index(x, y)].CopyTo(sample); }

  glm::ivec2 GetLow() const { return this->Low; }
  glm::ivec2 GetHigh() const { return this->High; }

private:
  /// The part of a sample that pixels use, because there is one for each pixel of the image.
  struct Corner
  {
    glm::vec4 Color;
    std::uint32_t Surface, Primitive;
    float U, V;
    float Distance, OpaqueDepth;
    float Error, Noise;

    Corner(const Sample& sample = Sample())
      : Color(sample.Color),
        Surface(sample.FirstHit.Surface),
        Primitive(sample.FirstHit.Primitive),
        U(sample.FirstHit.U),
        V(sample.FirstHit.V),
        Distance(sample.FirstHit.Distance),
        OpaqueDepth(sample.OpaqueDepth),
        Error(sample.Error),
        Noise(sample.Noise)
    {
    }

    // Each value is stored once: reading a sample that was just stored by values waits for them.
    void CopyTo(Sample& sample) const
    {
      sample.Color = this->Color;
      sample.FirstHit.Surface = this->Surface;
      sample.FirstHit.Primitive = this->Primitive;
      sample.FirstHit.U = this->U;
      sample.FirstHit.V = this->V;
      sample.FirstHit.Distance = this->Distance;
      sample.FirstHit.NextNear = std::numeric_limits<float>::infinity();
      sample.FirstHit.CoincidentNear = 0.f;
      sample.FirstHit.NextInOrder = 0;
      sample.OpaqueDepth = this->OpaqueDepth;
      sample.Error = this->Error;
      sample.Noise = this->Noise;
      sample.LitBy = 0;
      sample.ShadowedFrom = 0;
    }
  };

  std::size_t Index(int x, int y) const
  {
    return static_cast<std::size_t>(y - this->Low.y) * (this->High.x - this->Low.x + 1) +
      (x - this->Low.x);
  }

  static constexpr int StripLength = 32;

  glm::ivec2 Low, High;
  glm::ivec2 CountedLow{ 0 };
  glm::ivec2 CountedHigh{ std::numeric_limits<int>::max() };
  /// Calls visit(block) for the blocks of a strip.
  template <typename Visit>
  void VisitStrip(int strip, const Visit& visit) const;
  void TraceBlock(const CameraRayTracer& tracer, glm::ivec2 block, bool packets,
    std::uint32_t penumbrae, RayCounts& regionCounts);
  std::uint32_t& FlagsAt(glm::ivec2 block, std::vector<std::uint32_t>& flags) const
  {
    return flags[static_cast<std::size_t>(block.y) * this->Blocks.x + block.x];
  }

  glm::ivec2 FirstBlock, Blocks;
  int StripsPerRow;
  std::vector<Corner> Corners;
  /// Per block, if there are lights with a size: lights that rays reached and did not reach, and
  /// lights that cast a penumbra.
  std::vector<std::uint32_t> LitBy, ShadowedFrom, Penumbrae;
};

}
#endif
