// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The result of a benchmark: measured values, each with its target.
#ifndef penumbra_ResultTable_h
#define penumbra_ResultTable_h

#include <string>
#include <vector>

namespace penumbra
{

enum class TargetKind
{
  AtMost,
  AtLeast,
  None ///< reported for comparison
};

struct BenchmarkResult
{
  std::string Scene;
  std::string Quantity;
  double Measured;
  TargetKind Direction;
  double Limit;
  std::string Remark;

  bool IsMet() const;
};

/// The results of a benchmark.
class ResultTable
{
public:
  /// Adds a result and prints it immediately.
  void Add(const std::string& scene, const std::string& quantity, double measured,
    TargetKind direction, double limit = 0.0, const std::string& remark = {});

  /// Writes NAME.csv and NAME.md with the heading `title`; `path` ends in NAME.
  void Write(const std::string& path, const std::string& title,
    const std::vector<std::string>& circumstances) const;

  /// Names of the results that missed their target.
  std::vector<std::string> GetFailed() const;

private:
  std::vector<BenchmarkResult> Figures;
};

}
#endif
