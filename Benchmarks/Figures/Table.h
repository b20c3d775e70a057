// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The result of a benchmark: measured figures, each with its bar.
#ifndef penumbra_Table_h
#define penumbra_Table_h

#include <string>
#include <vector>

namespace penumbra
{

enum class Bar
{
  AtMost,
  AtLeast,
  None ///< reported for comparison
};

struct Figure
{
  std::string Scene;
  std::string Quantity;
  double Measured;
  Bar Direction;
  double Limit;
  std::string Remark;

  bool IsMet() const;
};

class Table
{
public:
  /// Adds a figure and prints it at once.
  void Add(const std::string& scene, const std::string& quantity, double measured, Bar direction,
    double limit = 0.0, const std::string& remark = {});

  /// Writes NAME.csv and NAME.md, whose heading is `title`; `path` ends in NAME.
  void Write(const std::string& path, const std::string& title,
    const std::vector<std::string>& circumstances) const;

  /// Names of figures that missed their bar.
  std::vector<std::string> GetMissed() const;

private:
  std::vector<Figure> Figures;
};

}
#endif
