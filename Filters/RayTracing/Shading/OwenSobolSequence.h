// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Owen-scrambled Sobol (0, 2)-sequence in the unit square, shuffled and scrambled with the hash of
// Laine and Karras and the constants of Burley ("Practical Hash-based Owen Scrambling", 2020).
// Among the first 2^k points, each elementary interval with sides 2^-i and 2^-j, i + j = k,
// contains exactly one.
#ifndef penumbra_OwenSobolSequence_h
#define penumbra_OwenSobolSequence_h

#include "HemisphereSampling.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace penumbra
{

class OwenSobolSequence
{
public:
  /// Sequences of different seeds are independent of each other.
  explicit OwenSobolSequence(std::uint32_t seed)
    : SeedX(MixBits(seed)),
      SeedY(MixBits(seed + 0x9e3779b9u)) // a hash that is independent of SeedX
  {
  }

  /// Returns the point of an index.
  glm::vec2 At(std::uint32_t index) const
  {
    return { ToUnit(FastOwenScramble(index, this->SeedX)),
      ToUnit(FastOwenScramble(MultiplyByPascalMatrix(index), this->SeedY)) };
  }

  /// Returns an index such that the points of shuffled indices, paired with those of another sequence at
  /// the indices themselves, are stratified in both, but independent of each other. Blocks of 2^k indices
  /// that begin at a multiple of 2^k become such blocks.
  static std::uint32_t ShuffleIndex(std::uint32_t index, std::uint32_t seed)
  {
    return FastOwenScramble(ReverseBits32(index), MixBits(seed));
  }

  /// Returns the bit mask m such that, among the first `count` points, the points i and i XOR m
  /// share one of `count` / 2 congruent, nearly square cells. `count` must be a power of two in [4,
  /// 2^30].
  static std::uint32_t FindPartner(std::uint32_t count)
  {
    int bits = 0;
    while (count >> (bits + 2) != 0)
    {
      ++bits;
    }
    const int horizontalBits = (bits + 1) / 2;
    const int verticalBits = bits - horizontalBits;
    std::uint32_t partner = 1u << horizontalBits;
    while (verticalBits > 0 && SobolDimension1(partner) >> (32 - verticalBits) != 0)
    {
      partner += 1u << horizontalBits;
    }
    return partner;
  }

  /// Returns half the sum of (a - b)^2 over all values a, where b is the value of the point that shares the cell of a,
  /// see FindPartner(). Its square root divided by the number of values estimates the standard error of their mean.
  /// Values are numbers, or colors, of which it returns the largest channel.
  template <typename Value>
  static double SumPairDifferences(const std::vector<Value>& values)
  {
    const auto count = static_cast<std::uint32_t>(values.size());
    const std::uint32_t partner = FindPartner(count);
    glm::dvec3 sum(0.0);
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const glm::dvec3 difference(values[i] - values[i ^ partner]);
      sum += difference * difference;
    }
    return .5 * std::max({ sum.x, sum.y, sum.z });
  }

private:
  /// Returns the unscrambled second coordinate of the sequence, as a fraction of 2^32.
  static std::uint32_t SobolDimension1(std::uint32_t index)
  {
    return ReverseBits32(MultiplyByPascalMatrix(index));
  }

  /// Multiplies the bits of an index by Pascal's triangle modulo 2, block by block (Ahmed, "An
  /// Implementation Algorithm of 2D Sobol Sequence Fast, Elegant, and Compact", 2024).
  static std::uint32_t MultiplyByPascalMatrix(std::uint32_t x)
  {
    x ^= x >> 16;
    x ^= x >> 8 & 0x00ff00ffu;
    x ^= x >> 4 & 0x0f0f0f0fu;
    x ^= x >> 2 & 0x33333333u;
    return x ^ (x >> 1 & 0x55555555u);
  }

  static std::uint32_t ReverseBits32(std::uint32_t x)
  {
    x = x << 16 | x >> 16;
    x = (x & 0x00ff00ffu) << 8 | (x & 0xff00ff00u) >> 8;
    x = (x & 0x0f0f0f0fu) << 4 | (x & 0xf0f0f0f0u) >> 4;
    x = (x & 0x33333333u) << 2 | (x & 0xccccccccu) >> 2;
    return (x & 0x55555555u) << 1 | (x & 0xaaaaaaaau) >> 1;
  }

  /// Scrambles a coordinate given with reversed bits: a hash of the higher bits decides whether a
  /// bit is flipped.
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

/// Mean of a color over the unit square, and its standard error.
struct StratifiedMean
{
  glm::dvec3 Mean{ 0.0 };
  double Error = 0.0; ///< of the channel with the largest error
};

/// Estimates the mean of a color at points of the unit square. evaluate(const glm::vec2* at, std::uint32_t count,
/// glm::vec3* values) computes the values at up to 16 points. Their number, a power of two, is doubled from `first` to
/// at most `maximum` until the error of every channel is at most `tolerance`, or this times `firstErrorFraction` after
/// the first round. `difference`: of one more pair of values; pairs agree by chance.
template <typename Evaluate>
StratifiedMean EstimateMeanOfBatches(const Evaluate& evaluate, std::uint32_t seed,
  std::uint32_t first, std::uint32_t maximum, double tolerance, double firstErrorFraction = 1.0,
  double difference = 0.0)
{
  constexpr std::uint32_t BatchSize = 16;
  StratifiedMean result;
  const OwenSobolSequence samples(seed);
  glm::dvec3 sum(0.0);
  std::vector<glm::vec3> values;
  for (std::uint32_t count = first;; count *= 2)
  {
    const auto known = static_cast<std::uint32_t>(values.size());
    values.resize(count);
    for (std::uint32_t begin = known; begin < count; begin += BatchSize)
    {
      const std::uint32_t size = std::min(count - begin, BatchSize);
      glm::vec2 at[BatchSize];
      for (std::uint32_t i = 0; i < size; ++i)
      {
        at[i] = samples.At(begin + i);
      }
      evaluate(at, size, values.data() + begin);
    }
    for (std::uint32_t i = known; i < count; ++i)
    {
      sum += values[i];
    }
    const double pairs = OwenSobolSequence::SumPairDifferences(values);
    result.Error = std::sqrt(pairs + difference * difference) / count;
    const double accepted = (count == first ? firstErrorFraction : 1.0) * tolerance;
    if (result.Error <= accepted || count > maximum / 2)
    {
      result.Mean = sum / static_cast<double>(count);
      return result;
    }
  }
}

/// The same with a function that computes one value: glm::vec3 evaluate(glm::vec2 at).
template <typename Evaluate>
StratifiedMean EstimateStratifiedMean(const Evaluate& evaluate, std::uint32_t seed,
  std::uint32_t first, std::uint32_t maximum, double tolerance)
{
  const auto evaluateEach = [&](const glm::vec2* at, std::uint32_t count, glm::vec3* values) {
    std::transform(at, at + count, values, evaluate);
  };
  return EstimateMeanOfBatches(evaluateEach, seed, first, maximum, tolerance);
}

}
#endif
