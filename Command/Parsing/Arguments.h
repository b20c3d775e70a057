// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Options whose values are lists of numbers, on top of CLI11, with messages that name the option.
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

/// What a number may be.
struct Range
{
  double Minimum = -Infinity;
  double Maximum = Infinity;
  bool IsExclusive = false;   ///< Least itself is too small
  bool AllowInfinity = false; ///< "inf" is a value
};

/// The numbers of `text`, separated by commas. Throws CLI::ValidationError naming `option`.
std::vector<double> ParseNumbers(const std::string& option, const std::string& text,
  std::size_t least, std::size_t most, const Range& range);

///@{
/// Declare an option; of several uses the last one wins. `name`: "--name", or several with commas.
CLI::Option* AddTriple(CLI::App& app, const std::string& name, std::optional<Vector3>& target,
  const std::string& description, const Range& range = {});
CLI::Option* AddDirection(CLI::App& app, const std::string& name, std::optional<Vector3>& target,
  const std::string& description);
CLI::Option* AddColor(CLI::App& app, const std::string& name, std::optional<Vector3>& target,
  const std::string& description);
CLI::Option* AddNumber(CLI::App& app, const std::string& name, double& target,
  const std::string& unit, const std::string& description, const Range& range = {});
CLI::Option* AddInteger(CLI::App& app, const std::string& name, int& target,
  const std::string& description, int least, int most);
CLI::Option* AddChoice(CLI::App& app, const std::string& name, std::string& target,
  const std::vector<std::string>& choices, const std::string& description);
///@}

}
#endif
