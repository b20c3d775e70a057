// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// JSON objects of numbers, texts and lists. Only the source includes the JSON library.
#ifndef penumbra_JsonObject_h
#define penumbra_JsonObject_h

#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace penumbra
{

using JsonMember = std::variant<double, std::string, std::vector<double>, std::vector<std::string>>;
using JsonObject = std::map<std::string, JsonMember>;

/// Returns the object as text, one member per line. All numbers must be finite.
std::string FormatJsonObject(const JsonObject& object);

/// Parses an object; an empty list becomes one of numbers. Throws std::runtime_error if the text is
/// not JSON or a member has another type.
JsonObject ParseJsonObject(const std::string& text);

/// An option with its values; a list of numbers is one value.
using JsonOption = std::pair<std::string, std::vector<std::string>>;

/// Parses an object of options in any order: numbers, texts, booleans ("true", "false"), lists of
/// numbers ("1,2,3"), and lists of these for options that are repeated. Throws std::runtime_error.
std::vector<JsonOption> ParseJsonOptions(const std::string& text);

/// Parses a file series: names of files with their times. Throws std::runtime_error.
std::vector<std::pair<std::string, double>> ParseJsonSeries(const std::string& text);

}
#endif
