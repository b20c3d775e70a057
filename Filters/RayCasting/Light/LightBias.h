// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Estimates the bias of joined light from the changes between levels, and its variance from the difference of both
// halves of the rays.
#ifndef penumbra_LightBias_h
#define penumbra_LightBias_h

#include "LightConstants.h"
#include "LightSite.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{

/// Squared changes of the estimates of a patch between levels; the first one: from the sites alone.
template <int N>
struct LevelChanges
{
  using Value = typename LightTerms<N>::Value;
  float Weights[LightLevels] = {}; ///< in pixels
  Value Sums[LightLevels] = {};
  Value Totals[LightLevels] = {}; ///< of the changes from the first level
  /// Of independent rays: of the sites alone, and of each level.
  Value Variances[LightLevels + 1] = {};
  /// Of both halves of each level, squared, as variances of their mean.
  Value Differences[LightLevels] = {};

  void Add(const LevelChanges& other, float weight)
  {
    for (int i = 0; i < LightLevels; ++i)
    {
      this->Weights[i] += weight * other.Weights[i];
      this->Sums[i] += weight * other.Sums[i];
      this->Totals[i] += weight * other.Totals[i];
      this->Variances[i] += weight * other.Variances[i];
      this->Differences[i] += weight * other.Differences[i];
    }
    this->Variances[LightLevels] += weight * other.Variances[LightLevels];
  }
};

/// Estimated squared change from each level to the next; after Accumulate(): from the sites alone.
template <int N>
struct PatchBias
{
  using Value = typename LightTerms<N>::Value;
  Value Squares[LightLevels] = {};
  Value Gains[LightLevels] = {}; ///< variances of the levels, relative to that of independent rays

  PatchBias() = default;

  /// The change that was found is weighed against the one that is expected from that between the next
  /// coarser levels: in the ratio of a region, if given.
  PatchBias(const LevelChanges<N>& changes, const PatchBias* region)
  {
    if (region)
    {
      std::copy(region->Gains, region->Gains + LightLevels, this->Gains);
    }
    else
    {
      this->MeasureGains(changes);
    }
    for (int l = LightLevels - 1; l >= 0; --l)
    {
      this->Squares[l] = Weigh(changes.Sums[l] / changes.Weights[l], this->Expect(l, region),
        this->ComputeNoise(changes, l));
    }
  }

  /// Replaces the changes between levels by those from the sites alone: squares add up, but at least the changes from
  /// the first level. These are larger where the changes between levels have the same sign.
  void Accumulate(const LevelChanges<N>& changes)
  {
    const Value noise = this->ComputeNoise(changes, 1);
    for (int l = 1; l < LightLevels; ++l)
    {
      const Value total = Weigh(changes.Totals[l] / changes.Weights[l], Value(0.f), noise);
      this->Squares[l] =
        glm::max(this->Squares[l - 1] + this->Squares[l], this->Squares[0] + total);
    }
  }

private:
  /// The measured ratios are weighed against that of the next finer level.
  void MeasureGains(const LevelChanges<N>& changes)
  {
    Value expected(WindowVarianceGain);
    for (int l = 0; l < LightLevels; ++l)
    {
      const float units = changes.Weights[1] / (SharedBlocks * static_cast<float>(4 << 2 * l));
      const Value measured = changes.Differences[l] / (changes.Variances[l + 1] + 1e-20f);
      expected = (ExpectedModels * expected + units * measured) / (ExpectedModels + units);
      this->Gains[l] = expected;
    }
  }

  /// Returns the standard error of the mean square of a change.
  Value ComputeNoise(const LevelChanges<N>& changes, int level) const
  {
    const Value gain = level > 0 ? this->Gains[level - 1] : Value(1.f);
    const auto pixels = static_cast<float>(1 << 2 * level); // of a block
    const float units = changes.Weights[level] / pixels;
    return 2.f * gain * changes.Variances[level] / changes.Weights[level] / std::sqrt(units);
  }

  /// Weighs a mean square against the expected one, and adds a part of its standard error.
  static Value Weigh(const Value& found, const Value& expected, const Value& noise)
  {
    const Value spread = glm::max(expected, found - noise);
    const Value certainty = spread * spread / (spread * spread + noise * noise + 1e-20f);
    return glm::max(expected + certainty * (found - expected), Value(0.f)) +
      BiasCaution * glm::sqrt(certainty) * noise;
  }

  Value Expect(int level, const PatchBias* region) const
  {
    if (level + 1 == LightLevels)
    {
      return Value(0.f);
    }
    const Value* const squares = region ? region->Squares + level : this->Squares + level + 1;
    const float smallest = region ? 0.f : SmallestBiasRatio;
    Value ratio(LargestBiasRatio);
    for (int i = 0; i < N && (region || level + 2 < LightLevels); ++i)
    {
      ratio[i] = squares[1][i] > 0.f
        ? std::clamp(squares[0][i] / squares[1][i], smallest, LargestBiasRatio)
        : LargestBiasRatio;
    }
    return ratio * this->Squares[level + 1];
  }
};

}
#endif
