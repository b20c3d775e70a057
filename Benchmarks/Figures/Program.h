// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What every program of figures does: read options, measure the parts that are asked for, write the
// table.
#ifndef penumbra_Program_h
#define penumbra_Program_h

#include "ResultTable.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace penumbra
{

struct Program
{
  struct Part
  {
    std::string Name; ///< after --only; empty: measured in any case
    std::function<void()> Measure;
  };
  /// An option that is followed by a value.
  struct Value
  {
    std::string Option;
    std::string* Where;
    bool Required = false;
  };
  /// An option that stands alone, and what it sets.
  struct Switch
  {
    std::string Option;
    bool* Where;
    bool Set = true;
  };

  std::string Name;  ///< of the files of results
  std::string Title; ///< of the table
  std::string Usage; ///< the options, for the message
  std::vector<Value> Values;
  std::vector<Switch> Switches;
  std::vector<Part> Parts; ///< in this order

  /// Measures and writes the table to the folder `output`, which is one of the values. Returns the
  /// exit status: 0 all bars met, 1 some missed, 2 bad use or a failure that was told.
  int Run(int argc, char** argv, ResultTable& results, const std::string& output,
    const std::function<std::vector<std::string>()>& circumstances);

private:
  /// The part to measure, empty for all, and whether the options were understood.
  std::pair<std::string, bool> ReadOptions(int argc, char** argv) const;
};

/// "date: ..." and "VTK ..., compiler ...", for the circumstances.
std::string DateLine();
std::string VersionLine();

}
#endif
