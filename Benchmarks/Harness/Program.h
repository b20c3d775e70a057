// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Command line of a benchmark program: parses the options, runs the requested parts, and writes the
// table.
#ifndef penumbra_Harness_Program_h
#define penumbra_Harness_Program_h

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
  /// An option without a value, and the variable that it sets.
  struct Switch
  {
    std::string Option;
    bool* Where;
    bool Set = true;
  };

  std::string Name;  ///< base name of the result files
  std::string Title; ///< heading of the table
  std::string Usage; ///< options, for the usage message
  std::vector<Value> Values;
  std::vector<Switch> Switches;
  std::vector<Part> Parts; ///< measured in this order

  /// Runs the measurements and writes the table to the folder `output`, which is one of the values. Its head has
  /// RunLine(), VersionLine() and `circumstances`.
  /// Returns the exit status: 0 if all targets are met, 1 if some are missed, 2 after invalid usage
  /// or a reported error.
  int Run(int argc, char** argv, ResultTable& results, const std::string& output,
    const std::function<std::vector<std::string>()>& circumstances);

private:
  /// Parses the options. Returns the part to measure (empty for all) and whether the options are
  /// valid.
  std::pair<std::string, bool> ReadOptions(int argc, char** argv) const;
};

/// For the head of a table: the command, commit, date and machine that `./penumbra benchmark` passes in the environment
/// variable PENUMBRA_RUN, without it the date alone; and "VTK ..., compiler ...".
std::string RunLine();
std::string VersionLine();

}
#endif
