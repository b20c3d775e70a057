// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Moments of the sites of one surface in a block of cells, and the linear model
// that they determine.
#ifndef penumbra_LightPatch_h
#define penumbra_LightPatch_h

#include "LightSite.h"

#include <cstdint>

namespace penumbra
{

/// Weighted moments of features and of values, about the means. There is a value per half of the rays.
template <int N>
struct LightPatch
{
  using Value = typename LightTerms<N>::Value;
  static constexpr int Products = LightFeatures::Count * (LightFeatures::Count + 1) / 2;

  float Weight = 0.f;        ///< in rays
  float SquaredWeight = 0.f; ///< sum of w^2 times rays, where w is the weight of the window
  float Sites = 0.f;         ///< number of sites, weighted
  float Parts = 0.f;         ///< sum of the parts of the pixels that they cover, weighted
  Value Variance{ 0.f };     ///< sum over these parts of the variance of a ray
  float Footprint = 0.f;     ///< largest
  std::uint16_t Layer = 0;
  LightFeatures Mean{};
  Value Means[Halves] = {};
  float Moments[Products] = {}; ///< of features, upper triangle row by row
  Value Cross[Halves][LightFeatures::Count] = {};

  /// Adds a site that covers `part` of its pixel.
  void Add(const LightSite<N>& site, float part);
  /// Adds another patch with all weights multiplied by `weight`.
  void Add(const LightPatch& other, float weight);

  /// Returns the variance of a ray. If all rays agree, the next one may still differ.
  Value GetVariance(const Value& squaredRange) const
  {
    return this->Variance / this->Parts + squaredRange / this->Weight;
  }

  /// Returns true if the patches may be parts of one surface.
  bool Matches(const LightPatch& other) const;
};

/// Linear function of the features, for each half of the rays.
template <int N>
struct LightModel
{
  using Value = typename LightTerms<N>::Value;
  LightFeatures Mean{};
  Value Means[Halves] = {};
  Value Slopes[Halves][LightFeatures::Count] = {};
  Value Variance{ 0.f }; ///< of the mean of both halves, if the rays are independent

  /// Fits the model to the sites of a window whose central block has `side`
  /// cells.
  void Fit(const LightPatch<N>& window, int side, const Value& squaredRange);

  /// Adds `weight` times the values at a point.
  void Evaluate(const LightFeatures& at, float weight, Value* values) const
  {
    for (int v = 0; v < Halves; ++v)
    {
      Value value = this->Means[v];
      for (int i = 0; i < LightFeatures::Count; ++i)
      {
        value += this->Slopes[v][i] * (at.At[i] - this->Mean.At[i]);
      }
      values[v] += weight * value;
    }
  }
};

extern template struct LightPatch<1>;
extern template struct LightPatch<3>;
extern template struct LightPatch<4>;
extern template struct LightModel<1>;
extern template struct LightModel<3>;
extern template struct LightModel<4>;

} // namespace penumbra
#endif
