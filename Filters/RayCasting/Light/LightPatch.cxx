// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LightPatch.h"

#include "LightConstants.h"
#include "Vectors.h"

#include <algorithm>
#include <cmath>

namespace penumbra
{
namespace
{

constexpr int Count = LightFeatures::Count;

} // namespace

template <int N>
void LightPatch<N>::Add(const LightSite<N>& site, float part)
{
  LightPatch single;
  float inverse = 0.f;
  for (int v = 0; v < Halves; ++v)
  {
    const auto rays = static_cast<float>(site.Rays[v]);
    single.Weight += rays;
    single.Means[v] = site.Sums[v] / rays;
    inverse += 1.f / rays;
  }
  single.SquaredWeight = single.Weight;
  single.Sites = 1.f;
  single.Parts = part;
  single.Variance = part * Square(single.Means[0] - single.Means[1]) / inverse;
  single.Footprint = site.Footprint;
  single.Layer = site.Layer;
  single.Mean = { site.Position, site.Normal };
  this->Add(single, 1.f);
}

template <int N>
void LightPatch<N>::Add(const LightPatch& other, float weight)
{
  const float added = weight * other.Weight;
  const float sum = this->Weight + added;
  const float fraction = added / sum;
  const float spread =
    this->Weight * fraction; // weight of the product of the differences of the means
  float d[Count];
  for (int i = 0; i < Count; ++i)
  {
    d[i] = other.Mean.At[i] - this->Mean.At[i];
  }
  int k = 0;
  for (int i = 0; i < Count; ++i)
  {
    for (int j = i; j < Count; ++j, ++k)
    {
      this->Moments[k] += weight * other.Moments[k] + spread * d[i] * d[j];
    }
  }
  for (int v = 0; v < Halves; ++v)
  {
    const Value difference = other.Means[v] - this->Means[v];
    for (int i = 0; i < Count; ++i)
    {
      this->Cross[v][i] += weight * other.Cross[v][i] + spread * difference * d[i];
    }
    this->Means[v] += fraction * difference;
  }
  for (int i = 0; i < Count; ++i)
  {
    this->Mean.At[i] += fraction * d[i];
  }
  this->Weight = sum;
  this->SquaredWeight += weight * weight * other.SquaredWeight;
  this->Sites += weight * other.Sites;
  this->Parts += weight * other.Parts;
  this->Variance += weight * other.Variance;
  this->Footprint = std::max(this->Footprint, other.Footprint);
  this->Layer = other.Layer;
}

template <int N>
bool LightPatch<N>::Matches(const LightPatch& other) const
{
  const glm::vec3 a = this->Mean.GetNormal();
  const glm::vec3 b = other.Mean.GetNormal();
  const float cosine = glm::dot(a, b);
  const float lengths = std::sqrt(glm::dot(a, a) * glm::dot(b, b));
  if (this->Layer != other.Layer || !(cosine >= SamePatchCosine * lengths))
  {
    return false;
  }
  const glm::vec3 offset = other.Mean.GetPosition() - this->Mean.GetPosition();
  const glm::vec3 normal = glm::normalize(a + b);
  return IsNearPlane(
    offset, normal, SamePatchHeight * std::max(this->Footprint, other.Footprint), SamePatchSlope);
}

template <int N>
void LightModel<N>::Fit(const LightPatch<N>& window, int side, const Value& squaredRange)
{
  this->Mean = window.Mean;
  const float position = 1.f / (PositionUnit * static_cast<float>(side) * window.Footprint);
  const float units[Count] = { position, position, position, 1.f / NormalUnit, 1.f / NormalUnit,
    1.f / NormalUnit };
  // Cholesky factorization of the products of the features in these units, plus
  // the ridge.
  float factor[Count][Count];
  float inverse[Count];
  int k = 0;
  for (int i = 0; i < Count; ++i)
  {
    for (int j = i; j < Count; ++j, ++k)
    {
      factor[j][i] = window.Moments[k] * units[i] * units[j];
    }
  }
  float freedom = 0.f;
  for (int i = 0; i < Count; ++i)
  {
    const float own = factor[i][i];
    float pivot = own + RidgeRays;
    for (int m = 0; m < i; ++m)
    {
      pivot -= Square(factor[i][m]);
    }
    pivot = std::max(pivot, RidgeRays);
    freedom += (pivot - RidgeRays) / pivot;
    inverse[i] = 1.f / std::sqrt(pivot);
    for (int j = i + 1; j < Count; ++j)
    {
      float sum = factor[j][i];
      for (int m = 0; m < i; ++m)
      {
        sum -= factor[j][m] * factor[i][m];
      }
      factor[j][i] = sum * inverse[i];
    }
  }
  for (int v = 0; v < Halves; ++v)
  {
    Value solution[Count];
    for (int i = 0; i < Count; ++i)
    {
      Value sum = window.Cross[v][i] * units[i];
      for (int m = 0; m < i; ++m)
      {
        sum -= factor[i][m] * solution[m];
      }
      solution[i] = sum * inverse[i];
    }
    for (int i = Count - 1; i >= 0; --i)
    {
      Value sum = solution[i];
      for (int m = i + 1; m < Count; ++m)
      {
        sum -= factor[m][i] * solution[m];
      }
      solution[i] = sum * inverse[i];
      this->Slopes[v][i] = solution[i] * units[i];
    }
    this->Means[v] = window.Means[v];
  }
  const Value variance = window.GetVariance(squaredRange);
  const float effective = Square(window.Weight) / window.SquaredWeight;
  this->Variance = variance * (1.f + 0.5f * freedom) / effective;
}

template struct LightPatch<1>;
template struct LightPatch<3>;
template struct LightPatch<4>;
template struct LightModel<1>;
template struct LightModel<3>;
template struct LightModel<4>;

} // namespace penumbra
