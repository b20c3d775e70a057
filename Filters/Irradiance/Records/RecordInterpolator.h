// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// One answer from several records.
#ifndef penumbra_RecordInterpolator_h
#define penumbra_RecordInterpolator_h

#include "Record.h"

#include <array>

namespace penumbra
{

/// What the cache says about a place.
struct InterpolationResult
{
  glm::vec3 Mean{ 0.f };
  float Error = 0.f;         ///< as far as the records can tell: their noise, and their bends
  float MaximumWeight = 0.f; ///< weight of the record that serves best; 0: no record serves
  bool Found() const { return this->MaximumWeight > 0.f; }
};

/// Records on their way into one answer. With weights w_i, places p_i, values F_i and gradients g_i the
/// answer is the mean of F_i + g_i (p - p_i) / 2, and half of the mean gradient times the mean of
/// p - p_i: where records lie all around, what a second derivative adds to values and takes from
/// gradients cancels out; a single record is followed along its gradient.
class RecordInterpolator
{
public:
  void Add(const Record& record, const ShadingPoint& place, float weight);
  InterpolationResult Result() const;

private:
  float Weights = 0.f;
  float Greatest = 0.f;
  float Noise = 0.f;
  float Bias = 0.f;
  glm::vec3 First{ 0.f };   ///< the first value: where all are the same, so is the answer
  glm::vec3 Halfway{ 0.f }; ///< from there
  glm::vec3 Offset{ 0.f };
  glm::vec3 Turn{ 0.f };
  std::array<glm::vec3, 3> Translation{};
  std::array<glm::vec3, 3> Rotation{};
};

}
#endif
