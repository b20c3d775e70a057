// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Bins filled in parallel. The result does not depend on the number of threads.
#ifndef penumbra_ParallelBins_h
#define penumbra_ParallelBins_h

#include "ParallelFor.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace penumbra
{

/// Maximum number of counters of all tasks, one per bin and task.
constexpr std::size_t MaximumBinCounters = 1 << 22;

/// Values sorted into bins, in one array.
template <typename Value>
class Bins
{
public:
  /**
   * Fills `bins` bins with values, in the order of the items that add them. visit(first, last, add)
   * calls add(bin, value) for the items in [first, last) of [0, count). It is called twice for each
   * part, in several threads, and must do the same each time. A bin has less than 2^32 values.
   */
  template <typename Visit>
  void Fill(std::size_t count, std::size_t bins, const Visit& visit);

  /// Returns the number of bins: 0 before Fill().
  std::size_t GetNumberOfBins() const { return this->Ends.size() - 1; }
  std::size_t GetNumberOfValues() const { return this->Values.size(); }
  std::size_t GetCount(std::size_t bin) const { return this->Ends[bin + 1] - this->Ends[bin]; }
  /// Returns the values of a bin.
  const Value* Get(std::size_t bin) const { return this->Values.data() + this->Ends[bin]; }

private:
  std::vector<std::size_t> Ends{
    0
  }; ///< end of each bin in Values, after the beginning of the first
  std::vector<Value> Values;
};

template <typename Value>
template <typename Visit>
void Bins<Value>::Fill(std::size_t count, std::size_t bins, const Visit& visit)
{
  const std::size_t maximumParts = std::max<std::size_t>(MaximumBinCounters / (bins + 1), 1);
  const std::vector<std::size_t> boundaries =
    SplitIntoParts(count, std::max(ArrayGrain, count / maximumParts + 1));
  const std::size_t parts = boundaries.size() - 1;
  // Number of values of each bin in each part, then their first index in the bin.
  std::vector<std::vector<std::uint32_t>> counts(parts);
  ParallelFor<std::size_t>(0, parts, 1, [&](std::size_t part) {
    counts[part].assign(bins, 0);
    visit(boundaries[part], boundaries[part + 1],
      [&](std::size_t bin, const Value&) { ++counts[part][bin]; });
  });
  this->Ends.resize(bins + 1);
  for (std::size_t bin = 0; bin < bins; ++bin)
  {
    std::uint32_t sum = 0;
    for (std::vector<std::uint32_t>& inPart : counts)
    {
      sum += std::exchange(inPart[bin], sum);
    }
    this->Ends[bin + 1] = this->Ends[bin] + sum;
  }
  this->Values.resize(this->Ends[bins]);
  ParallelFor<std::size_t>(0, parts, 1, [&](std::size_t part) {
    visit(boundaries[part], boundaries[part + 1], [&](std::size_t bin, const Value& value) {
      this->Values[this->Ends[bin] + counts[part][bin]++] = value;
    });
  });
}

}
#endif
