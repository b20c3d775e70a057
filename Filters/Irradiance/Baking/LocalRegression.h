// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What neighbours know: where a quantity is smooth, uncertain answers at many places make each other
// certain. To a place and those around a function is fitted, linear in place and normal.
#ifndef penumbra_LocalRegression_h
#define penumbra_LocalRegression_h

#include "Records/RecordPlacement.h"

#include <array>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace penumbra
{

/// A mean over the hemisphere, one channel, and its standard error.
struct NoisyEstimate
{
  float Mean = 0.f;
  float Error = std::numeric_limits<float>::infinity();
};

class VTKPENUMBRAFILTERSIRRADIANCE_EXPORT LocalRegression
{
public:
  /// Of `sites` those that `which` names; `spacing`: usual distance of neighbouring ones.
  LocalRegression(const std::vector<RecordCandidate>& sites, const std::vector<std::size_t>& which,
    float spacing);

  /// What the answers (one for each of the sites) at and around site `index` say about it. The error
  /// holds their noise and what the function does not follow; infinite where there are too few.
  NoisyEstimate Fit(std::size_t index, const std::vector<NoisyEstimate>& answers) const;

private:
  /// Place and normal relative to the site asked for: 1, two coordinates, two tilts.
  static constexpr int Terms = 5;
  struct Row
  {
    std::array<double, Terms> Term;
    double Weight;
    NoisyEstimate Answer;
  };

  void FindRows(
    std::size_t index, const std::vector<NoisyEstimate>& answers, std::vector<Row>& rows) const;
  std::array<std::int64_t, 3> CellOf(glm::vec3 position) const;
  static std::uint64_t KeyOf(const std::array<std::int64_t, 3>& cell);

  const std::vector<RecordCandidate>& Sites;
  float Reach;                    ///< also the side of a cell
  std::vector<std::size_t> Order; ///< sites, cell by cell
  std::unordered_map<std::uint64_t, std::pair<std::size_t, std::size_t>> Cells; ///< parts of it
};

}
#endif
