// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The options that select time steps.
#ifndef penumbra_TimeOptions_h
#define penumbra_TimeOptions_h

#include "Input/TimeSteps.h"
#include "Parsing/Arguments.h"
#include "Processes/CommandConstants.h"

#include <optional>
#include <string>
#include <vector>

namespace penumbra
{

/// The value of --times.
struct TimeRange
{
  double First = -Infinity;
  double Last = Infinity;
  double Increment = 0.0; ///< 0: every step between First and Last
};

struct TimeOptions
{
  std::optional<double> Time;
  std::optional<int> Step; ///< negative: from the last, which is -1
  std::optional<TimeRange> Range;

  bool IsSet() const { return this->Time || this->Step || this->Range; }
};

/// Declares the options on `app`; parsing fills `time`, which must outlive `app`.
void DeclareTimeOptions(const CommandLine& app, TimeOptions& time);

/// Throws CommandError if options contradict each other.
void CheckTimeOptions(const CommandLine& app);

/// Returns the times that the options select, all of them if no option is given. Throws
/// CommandError if there are none. `input`: name of the input, for messages.
std::vector<double> SelectTimes(
  const TimeOptions& options, const Timeline& timeline, const std::string& input);

/// Returns a time with `digits` significant digits.
std::string FormatTime(double time, int digits = TimeDigits);

/// Returns times with the fewest digits, at least TimeDigits, by which they are distinct.
std::vector<std::string> FormatTimes(const std::vector<double>& times);

}
#endif
