// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RecordInterpolator.h"

namespace penumbra
{
namespace
{

/// Estimated error of a record, over its Hessian norm times the squared distance. It is 1/2 in the
/// direction of the maximum second derivative and less in others.
constexpr float HessianErrorFraction = .25f;

}

void RecordInterpolator::Add(const Record& record, const ShadingPoint& place, float weight)
{
  const HemisphereEstimate& found = record.Gathered;
  const glm::vec3 d = place.Position - record.Position;
  const glm::vec3 turn = place.Normal - record.Normal;
  this->First = this->Weights > 0.f ? this->First : found.Mean;
  this->Weights += weight;
  this->Greatest = std::max(this->Greatest, weight);
  this->Noise += weight * weight * found.Error * found.Error;
  this->Bias += weight * HessianErrorFraction * found.HessianNorm * glm::dot(d, d);
  this->Offset += weight * d;
  this->Turn += weight * turn;
  for (int c = 0; c < 3; ++c)
  {
    const float change = glm::dot(found.Translation[c], d) + glm::dot(found.Rotation[c], turn);
    this->Halfway[c] += weight * (found.Mean[c] - this->First[c] + .5f * change);
    this->Translation[c] += weight * found.Translation[c];
    this->Rotation[c] += weight * found.Rotation[c];
  }
}

InterpolationResult RecordInterpolator::Result() const
{
  InterpolationResult result;
  if (this->Weights <= 0.f)
  {
    return result;
  }
  const float share = 1.f / this->Weights;
  for (int c = 0; c < 3; ++c)
  {
    const float change =
      glm::dot(this->Translation[c], this->Offset) + glm::dot(this->Rotation[c], this->Turn);
    result.Mean[c] =
      std::max(this->First[c] + share * (this->Halfway[c] + .5f * share * change), 0.f);
  }
  const float bias = share * this->Bias;
  result.Error = std::sqrt(share * share * this->Noise + bias * bias);
  result.MaximumWeight = this->Greatest;
  return result;
}

}
