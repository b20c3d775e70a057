// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// CLI11 options whose values are numbers, lists of numbers, colors or choices. Messages name the
// option. CLI11's validators Range and IsMember (2.1) are not used: they reject invalid values that
// a later one replaces, accept NaN, and read 010 as 8.
#ifndef penumbra_Arguments_h
#define penumbra_Arguments_h

#include <CLI/CLI.hpp>

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

/// Parses numbers separated by commas. Throws CLI::ValidationError naming `option`.
std::vector<double> ParseNumbers(const std::string& option, const std::string& text,
  std::size_t minimum, std::size_t maximum, const Range& range);

///@{
/// Adds an option; if it is repeated, the last value is used. `name`: "--name", or several
/// separated by commas.
CLI::Option* AddTriple(CLI::App& app, const std::string& name, std::optional<Vector3>& target,
  const std::string& description, const Range& range = {});
CLI::Option* AddDirection(CLI::App& app, const std::string& name, std::optional<Vector3>& target,
  const std::string& description);
CLI::Option* AddColor(CLI::App& app, const std::string& name, std::optional<Vector3>& target,
  const std::string& description);
CLI::Option* AddNumber(CLI::App& app, const std::string& name, double& target,
  const std::string& unit, const std::string& description, const Range& range = {});
CLI::Option* AddInteger(CLI::App& app, const std::string& name, int& target,
  const std::string& description, int minimum, int maximum);
CLI::Option* AddChoice(CLI::App& app, const std::string& name, std::string& target,
  const std::vector<std::string>& choices, const std::string& description);
///@}

}
#endif
