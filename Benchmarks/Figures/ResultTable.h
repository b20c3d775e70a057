// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The result of a benchmark: measured figures, each with its bar.
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

class ResultTable
{
public:
  /// Adds a figure and prints it at once.
  void Add(const std::string& scene, const std::string& quantity, double measured,
    TargetKind direction, double limit = 0.0, const std::string& remark = {});

  /// Writes NAME.csv and NAME.md, whose heading is `title`; `path` ends in NAME.
  void Write(const std::string& path, const std::string& title,
    const std::vector<std::string>& circumstances) const;

  /// Names of figures that missed their bar.
  std::vector<std::string> GetFailed() const;

private:
  std::vector<BenchmarkResult> Figures;
};

}
#endif
