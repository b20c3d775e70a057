// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Points of the unit square, any number of them spread evenly at every scale: the (0, 2)-sequence of
// Sobol in the random order of Owen (by the hash of Laine and Karras, with the constants of Burley,
// "Practical Hash-based Owen Scrambling", 2020). Of the first 2^k points each box of sides 2^-i and
// 2^-j with i + j = k holds exactly one.
#ifndef penumbra_OwenSobolSequence_h
#define penumbra_OwenSobolSequence_h

#include "HemisphereSampling.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace penumbra
{

class OwenSobolSequence
{
public:
  /// Sequences of different seeds are independent of each other.
  explicit OwenSobolSequence(std::uint32_t seed)
    : SeedX(MixBits(seed)),
      SeedY(MixBits(seed + 0x9e3779b9u)) // bit by bit independent of the other
  {
  }

  glm::vec2 At(std::uint32_t index) const
  {
    return { ToUnit(FastOwenScramble(index, this->SeedX)),
      ToUnit(FastOwenScramble(ReverseBits32(SobolDimension1(index)), this->SeedY)) };
  }

  /// What to combine (exclusive or) an index below `count`, a power of two from 4 to 2^30, with, to find
  /// the one point that shares its box: one of count / 2 boxes that are nearly squares.
  static std::uint32_t FindPartner(std::uint32_t count)
  {
    int bits = 0;
    while (count >> (bits + 2) != 0)
    {
      ++bits;
    }
    const int across = (bits + 1) / 2;
    const int up = bits - across;
    std::uint32_t partner = 1u << across;
    while (up > 0 && SobolDimension1(partner) >> (32 - up) != 0)
    {
      partner += 1u << across;
    }
    return partner;
  }

private:
  /// The sequence's second coordinate before scrambling, as a fraction of 2^32.
  static std::uint32_t SobolDimension1(std::uint32_t index)
  {
    std::uint32_t y = 0;
    for (std::uint32_t column = 0x80000000u; index != 0; index >>= 1, column ^= column >> 1)
    {
      y ^= index & 1u ? column : 0u;
    }
    return y;
  }

  static std::uint32_t ReverseBits32(std::uint32_t x)
  {
    x = x << 16 | x >> 16;
    x = (x & 0x00ff00ffu) << 8 | (x & 0xff00ff00u) >> 8;
    x = (x & 0x0f0f0f0fu) << 4 | (x & 0xf0f0f0f0u) >> 4;
    x = (x & 0x33333333u) << 2 | (x & 0xccccccccu) >> 2;
    return (x & 0x55555555u) << 1 | (x & 0xaaaaaaaau) >> 1;
  }

  /// Of a coordinate with its bits reversed: each bit is flipped or not as those above it tell.
  static std::uint32_t FastOwenScramble(std::uint32_t reversed, std::uint32_t seed)
  {
    reversed += seed;
    reversed ^= reversed * 0x6c50b47cu;
    reversed ^= reversed * 0xb82f1e52u;
    reversed ^= reversed * 0xc7afe638u;
    reversed ^= reversed * 0x8d22f6e6u;
    return ReverseBits32(reversed);
  }

  static float ToUnit(std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }

  std::uint32_t SeedX;
  std::uint32_t SeedY;
};

}
#endif
