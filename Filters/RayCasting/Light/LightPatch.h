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
struct LightPatch
{
  static constexpr int Products = LightFeatures::Count * (LightFeatures::Count + 1) / 2;

  float Weight = 0.f;        ///< in rays
  float SquaredWeight = 0.f; ///< sum of w^2 times rays, where w is the weight of the window
  float Sites = 0.f;         ///< number of sites, weighted
  float Parts = 0.f;         ///< sum of the parts of the pixels that they cover, weighted
  float Variance = 0.f;      ///< sum over these parts of the variance of a ray
  float Footprint = 0.f;     ///< largest
  std::uint16_t Layer = 0;
  LightFeatures Mean{};
  float Means[Halves] = {};
  float Moments[Products] = {}; ///< of features, upper triangle row by row
  float Cross[Halves][LightFeatures::Count] = {};

  /// Adds a site that covers `part` of its pixel.
  void Add(const LightSite& site, float part);
  /// Adds another patch with all weights multiplied by `weight`.
  void Add(const LightPatch& other, float weight);

  /// Returns the variance of a ray. If all rays agree, the next one may still differ.
  float GetVariance() const { return this->Variance / this->Parts + 1.f / this->Weight; }

  /// Returns true if the patches may be parts of one surface.
  bool Matches(const LightPatch& other) const;
};

/// Linear function of the features, for each half of the rays.
struct LightModel
{
  LightFeatures Mean{};
  float Means[Halves] = {};
  float Slopes[Halves][LightFeatures::Count] = {};
  float Variance = 0.f; ///< estimated, of the mean of both halves

  /// Fits the model to the sites of a window whose central block has `side`
  /// cells.
  void Fit(const LightPatch& window, int side);

  /// Adds `weight` times the values at a point.
  void Evaluate(const LightFeatures& at, float weight, float* values) const
  {
    for (int v = 0; v < Halves; ++v)
    {
      float value = this->Means[v];
      for (int i = 0; i < LightFeatures::Count; ++i)
      {
        value += this->Slopes[v][i] * (at.At[i] - this->Mean.At[i]);
      }
      values[v] += weight * value;
    }
  }
};

} // namespace penumbra
#endif
