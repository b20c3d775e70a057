// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RecordInterpolator.h"

#include "Gathering/IrradianceConstants.h"

namespace penumbra
{

void RecordInterpolator::Add(const Record& record, const ShadingPoint& point, float weight)
{
  const HemisphereEstimate& estimate = record.Gathered;
  const glm::vec3 d = point.Position - record.Position;
  const glm::vec3 normalOffset = point.Normal - record.Normal;
  this->First = this->Weights > 0.f ? this->First : estimate.Mean;
  this->Weights += weight;
  this->MaximumWeight = std::max(this->MaximumWeight, weight);
  this->Noise += weight * weight * estimate.Error * estimate.Error;
  this->Bias += weight * RecordErrorFraction * estimate.HessianNorm * glm::dot(d, d);
  this->Offset += weight * d;
  this->NormalOffset += weight * normalOffset;
  for (int c = 0; c < 3; ++c)
  {
    const float offsetTerm =
      glm::dot(estimate.Translation[c], d) + glm::dot(estimate.Rotation[c], normalOffset);
    this->MidpointSum[c] += weight * (estimate.Mean[c] - this->First[c] + .5f * offsetTerm);
    this->Translation[c] += weight * estimate.Translation[c];
    this->Rotation[c] += weight * estimate.Rotation[c];
  }
}

InterpolationResult RecordInterpolator::Result() const
{
  InterpolationResult result;
  if (this->Weights <= 0.f)
  {
    return result;
  }
  const float fraction = 1.f / this->Weights;
  for (int c = 0; c < 3; ++c)
  {
    const float offsetTerm = glm::dot(this->Translation[c], this->Offset) +
      glm::dot(this->Rotation[c], this->NormalOffset);
    result.Mean[c] = std::max(
      this->First[c] + fraction * (this->MidpointSum[c] + .5f * fraction * offsetTerm), 0.f);
  }
  const float bias = fraction * this->Bias;
  result.Error = std::sqrt(fraction * fraction * this->Noise + bias * bias);
  result.MaximumWeight = this->MaximumWeight;
  return result;
}

}
