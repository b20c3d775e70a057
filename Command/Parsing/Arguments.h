// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Options whose values are numbers, lists of numbers, colors or choices. Messages name the option.
// CLI11's validators Range and IsMember (2.1) are not used: they reject invalid values that a later
// one replaces, accept NaN, and read 010 as 8.
#ifndef penumbra_Arguments_h
#define penumbra_Arguments_h

#include "CommandLine.h"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace penumbra
{

using Vector3 = std::array<double, 3>;

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Range of valid numbers.
struct Range
{
  double Minimum = -Infinity;
  double Maximum = Infinity;
  bool IsExclusive = false;   ///< Minimum itself is invalid
  bool AllowInfinity = false; ///< "inf" is valid
};

/// Returns `texts` with `separator` between them.
std::string Join(const std::vector<std::string>& texts, const std::string& separator);

/// Parses numbers, such as 0.25, 1e-3 or 1/256, separated by commas. Throws InvalidValue naming `option`;
/// its message mentions `word`, if not empty, as another valid value.
std::vector<double> ParseNumbers(const std::string& option, const std::string& text,
  std::size_t minimum, std::size_t maximum, const Range& range,
  const std::string& word = std::string());

/// Parses `count` integers separated by commas. Exponents and fractions are invalid: 1e2 is likely a mistake.
/// Throws InvalidValue naming `option`.
std::vector<int> ParseIntegers(
  const std::string& option, const std::string& text, std::size_t count, int minimum, int maximum);

/// Parses one integer as ParseIntegers() does.
int ParseInteger(const std::string& option, const std::string& text, int minimum, int maximum);

///@{
/// Adds an option; if it is repeated, the last value is used. `name`: "--name", or several
/// separated by commas.
Option AddTriple(const CommandLine& app, const std::string& name, std::optional<Vector3>& target,
  const std::string& description, const Range& range = {});
Option AddDirection(const CommandLine& app, const std::string& name, std::optional<Vector3>& target,
  const std::string& description);
Option AddColor(const CommandLine& app, const std::string& name, std::optional<Vector3>& target,
  const std::string& description);
Option AddNumber(const CommandLine& app, const std::string& name, double& target,
  const std::string& unit, const std::string& description, const Range& range = {});
Option AddInteger(const CommandLine& app, const std::string& name, int& target,
  const std::string& description, int minimum, int maximum);
Option AddChoice(const CommandLine& app, const std::string& name, std::string& target,
  const std::vector<std::string>& choices, const std::string& description);
///@}

}
#endif
