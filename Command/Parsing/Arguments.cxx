// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Arguments.h"

#include "vtkNamedColors.h"
#include "vtkNew.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace penumbra
{

namespace
{

// Throws InvalidValue. `option`: the name, and others after commas; `word`: another valid value, or empty.
[[noreturn]] void ThrowInvalid(const std::string& option, const std::string& text,
  const std::string& expected, const std::string& word = std::string())
{
  const std::string wrong = word.empty() ? "' is not " : "' is neither " + word + " nor ";
  throw InvalidValue(option.substr(0, option.find(',')), "'" + text + wrong + expected);
}

std::string Describe(const Range& range)
{
  std::ostringstream text;
  text << "a number";
  if (range.Minimum > -Infinity && range.Maximum < Infinity)
  {
    text << (range.IsExclusive ? " above " : " from ") << range.Minimum
         << (range.IsExclusive ? " up to " : " to ") << range.Maximum;
  }
  else if (range.Minimum > -Infinity)
  {
    text << (range.IsExclusive ? " above " : " of at least ") << range.Minimum;
  }
  return text.str();
}

bool ParseDecimal(const std::string& text, double& value)
{
  const char* begin = text.c_str() + (text[0] == '+' ? 1 : 0);
  const char* end = text.c_str() + text.size();
  const std::from_chars_result result = std::from_chars(begin, end, value);
  return result.ec == std::errc() && result.ptr == end;
}

/// Parses a number or a fraction of two numbers.
bool ParseNumber(std::string text, double& value)
{
  const auto isSpace = [](unsigned char character) { return std::isspace(character) != 0; };
  text.erase(std::remove_if(text.begin(), text.end(), isSpace), text.end());
  const std::size_t slash = text.find('/');
  if (slash == text.npos)
  {
    return ParseDecimal(text, value);
  }
  double divisor = 0.0;
  const bool valid = ParseDecimal(text.substr(0, slash), value) &&
    ParseDecimal(text.substr(slash + 1), divisor) && divisor != 0.0;
  value /= valid ? divisor : 1.0;
  return valid;
}

// Formats a default value with six significant digits.
std::string Print(double value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

}

std::string Join(const std::vector<std::string>& texts, const std::string& separator)
{
  std::string joined;
  for (const std::string& text : texts)
  {
    joined += (joined.empty() ? "" : separator) + text;
  }
  return joined;
}

std::vector<double> ParseNumbers(const std::string& option, const std::string& text,
  std::size_t minimum, std::size_t maximum, const Range& range, const std::string& word)
{
  std::string expected = Describe(range);
  if (maximum > 1)
  {
    expected = std::to_string(minimum) +
      (maximum > minimum ? " or " + std::to_string(maximum) : "") + " numbers separated by commas" +
      (range.Minimum > -Infinity ? ", each " + Describe(range) : std::string());
  }
  std::vector<double> numbers;
  std::istringstream stream(text + ",");
  for (std::string part; std::getline(stream, part, ',');)
  {
    double value = 0.0;
    if (!ParseNumber(part, value) || std::isnan(value) ||
      (std::isinf(value) && !range.AllowInfinity) || value < range.Minimum ||
      value > range.Maximum || (range.IsExclusive && value == range.Minimum))
    {
      ThrowInvalid(option, text, expected, word);
    }
    numbers.push_back(value);
  }
  if (numbers.size() < minimum || numbers.size() > maximum)
  {
    ThrowInvalid(option, text, expected, word);
  }
  return numbers;
}

std::vector<int> ParseIntegers(
  const std::string& option, const std::string& text, std::size_t count, int minimum, int maximum)
{
  std::vector<int> integers;
  std::istringstream stream(text + ",");
  bool valid = text.find_first_of("eE/") == text.npos;
  for (std::string part; valid && std::getline(stream, part, ',');)
  {
    double value = 0.0;
    valid = ParseNumber(part, value) && value == std::floor(value) && value >= minimum &&
      value <= maximum;
    integers.push_back(valid ? static_cast<int>(value) : 0);
  }
  if (!valid || integers.size() != count)
  {
    const std::string range = std::to_string(minimum) + " to " + std::to_string(maximum);
    ThrowInvalid(option, text,
      count == 1 ? "an integer from " + range
                 : std::to_string(count) + " integers separated by commas, each from " + range);
  }
  return integers;
}

int ParseInteger(const std::string& option, const std::string& text, int minimum, int maximum)
{
  return ParseIntegers(option, text, 1, minimum, maximum)[0];
}

Option AddTriple(const CommandLine& app, const std::string& name, std::optional<Vector3>& target,
  const std::string& description, const Range& range)
{
  const auto store = [name, range, &target](const std::string& text) {
    const std::vector<double> numbers = ParseNumbers(name, text, 3, 3, range);
    target = Vector3{ numbers[0], numbers[1], numbers[2] };
  };
  return app.AddParsed(name, store, description).TypeName("X,Y,Z");
}

namespace
{

/// Parses axes with signs, such as "+Z" or "-X+Y"; returns false if the text is none.
bool ParseAxes(const std::string& text, Vector3& direction)
{
  const std::string axes = "xyz";
  double sign = 1.0;
  bool complete = false;
  for (const char c : text)
  {
    if (c == '+' || c == '-')
    {
      sign = c == '-' ? -1.0 : 1.0;
      complete = false;
      continue;
    }
    const std::size_t axis = axes.find(static_cast<char>(std::tolower(c)));
    if (axis == axes.npos)
    {
      return false;
    }
    direction[axis] = sign;
    sign = 1.0;
    complete = true;
  }
  return complete;
}

}

Option AddDirection(const CommandLine& app, const std::string& name, std::optional<Vector3>& target,
  const std::string& description)
{
  const auto store = [name, &target](const std::string& text) {
    target = Vector3{};
    if (ParseAxes(text, *target))
    {
      return;
    }
    const std::vector<double> numbers = ParseNumbers(name, text, 3, 3, {}, "an axis such as +Z");
    std::copy(numbers.begin(), numbers.end(), target->begin());
    if (*target == Vector3{})
    {
      throw InvalidValue(name, "'" + text + "' is not a direction; give a nonzero vector");
    }
  };
  return app.AddParsed(name, store, description).TypeName("X,Y,Z|+X|-X|...");
}

Option AddColor(const CommandLine& app, const std::string& name, std::optional<Vector3>& target,
  const std::string& description)
{
  const auto store = [name, &target](const std::string& text) {
    target = Vector3{};
    vtkNew<vtkNamedColors> names;
    if (names->ColorExists(text))
    {
      names->GetColorRGB(text, target->data());
      return;
    }
    unsigned int bytes = 0;
    const char* end = text.c_str() + text.size();
    const bool hexadecimal = text.size() == 7 && text[0] == '#' &&
      std::from_chars(text.c_str() + 1, end, bytes, 16).ptr == end;
    if (hexadecimal)
    {
      target =
        Vector3{ (bytes >> 16) / 255.0, (bytes >> 8 & 255u) / 255.0, (bytes & 255u) / 255.0 };
      return;
    }
    if (text.find(',') == text.npos)
    {
      ThrowInvalid(name, text, "the name of a color, #RRGGBB or 3 numbers separated by commas");
    }
    const std::vector<double> numbers = ParseNumbers(name, text, 3, 3, { 0.0, 1.0 });
    std::copy(numbers.begin(), numbers.end(), target->begin());
  };
  return app.AddParsed(name, store, description).TypeName("R,G,B|#RRGGBB|NAME");
}

Option AddNumber(const CommandLine& app, const std::string& name, double& target,
  const std::string& unit, const std::string& description, const Range& range)
{
  const auto store = [name, range, &target](const std::string& text) {
    target = ParseNumbers(name, text, 1, 1, range, range.AllowInfinity ? "`inf`" : "")[0];
  };
  return app.AddParsed(name, store, description)
    .TypeName(unit)
    .Default(std::isnan(target) ? "" : Print(target));
}

Option AddInteger(const CommandLine& app, const std::string& name, int& target,
  const std::string& description, int minimum, int maximum)
{
  const auto store = [name, minimum, maximum, &target](const std::string& text) {
    target = ParseInteger(name, text, minimum, maximum);
  };
  return app.AddParsed(name, store, description).TypeName("N").Default(std::to_string(target));
}

Option AddChoice(const CommandLine& app, const std::string& name, std::string& target,
  const std::vector<std::string>& choices, const std::string& description)
{
  const auto store = [name, choices, &target](const std::string& text) {
    if (!std::count(choices.begin(), choices.end(), text))
    {
      ThrowInvalid(name, text, "one of " + Join(choices, ", "));
    }
    target = text;
  };
  return app.AddParsed(name, store, description).TypeName(Join(choices, "|")).Default(target);
}

}
