// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Weighted interpolation between records.
#ifndef penumbra_RecordInterpolator_h
#define penumbra_RecordInterpolator_h

#include "Record.h"

#include <array>

namespace penumbra
{

/// Interpolated mean at a point.
struct InterpolationResult
{
  glm::vec3 Mean{ 0.f };
  float Error = 0.f;         ///< estimated from the noise and the second derivatives of the records
  float MaximumWeight = 0.f; ///< maximum weight of a record; 0 if no valid record was found
  bool IsInvalid = false;    ///< nothing was found because an invalid record has the largest weight
  bool Found() const { return this->MaximumWeight > 0.f; }
};

/// Accumulates records for one point. With positions p_i, means F_i and gradients g_i, the result
/// is the weighted mean of F_i + g_i (p - p_i) / 2 plus half of the mean gradient times the mean of
/// p - p_i. If records surround the point, the errors that second derivatives cause in means and in
/// gradients cancel. A single record is extrapolated along its gradient.
class RecordInterpolator
{
public:
  void Add(const Record& record, const ShadingPoint& point, float weight);
  InterpolationResult Result() const;

private:
  float Weights = 0.f;
  float MaximumWeight = 0.f;
  float Noise = 0.f;
  float Bias = 0.f;
  glm::vec3 First{ 0.f }; ///< first mean; sums are relative to it, so that equal means stay exact
  glm::vec3 MidpointSum{ 0.f }; ///< sum of means extrapolated half of the offset, minus First
  glm::vec3 Offset{ 0.f };
  glm::vec3 NormalOffset{ 0.f };
  std::array<glm::vec3, 3> Translation{};
  std::array<glm::vec3, 3> Rotation{};
};

}
#endif
