// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "JsonObject.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace penumbra
{

namespace
{

/// Integers below this limit are written without a fraction.
constexpr double MaximumInteger = 9007199254740992.0; // 2^53

nlohmann::json ToJson(double number)
{
  if (number == std::floor(number) && std::abs(number) < MaximumInteger)
  {
    return static_cast<long long>(number);
  }
  return number;
}

nlohmann::json ToJson(const std::string& text)
{
  return text;
}

template <typename Item>
nlohmann::json ToJson(const std::vector<Item>& items)
{
  nlohmann::json list = nlohmann::json::array();
  for (const Item& item : items)
  {
    list.push_back(ToJson(item));
  }
  return list;
}

JsonMember FromJson(const nlohmann::json& value)
{
  if (value.is_number())
  {
    return value.get<double>();
  }
  if (value.is_string())
  {
    return value.get<std::string>();
  }
  if (value.is_array() && !value.empty() && value[0].is_string())
  {
    return value.get<std::vector<std::string>>();
  }
  return value.get<std::vector<double>>();
}

/// Returns a value of an option as it stands on a command line.
std::string FormatOption(const std::string& name, const nlohmann::json& value)
{
  if (value.is_string())
  {
    return value.get<std::string>();
  }
  if (value.is_number() || value.is_boolean())
  {
    return value.dump();
  }
  std::string numbers;
  for (const nlohmann::json& number : value)
  {
    if (!value.is_array() || !number.is_number())
    {
      numbers.clear();
      break;
    }
    numbers += (numbers.empty() ? "" : ",") + number.dump();
  }
  if (numbers.empty())
  {
    throw std::runtime_error(
      "'" + name + "' is neither a number, a text, true or false, nor a list of these");
  }
  return numbers;
}

}

std::string FormatJsonObject(const JsonObject& object)
{
  std::string text;
  for (const auto& [name, member] : object)
  {
    text += text.empty() ? "{\n" : ",\n";
    text += " " + nlohmann::json(name).dump() + ": " +
      std::visit([](const auto& value) { return ToJson(value); }, member).dump();
  }
  return text + "\n}\n";
}

JsonObject ParseJsonObject(const std::string& text)
{
  JsonObject object;
  try
  {
    const nlohmann::json json = nlohmann::json::parse(text);
    for (const auto& [name, value] : json.items())
    {
      object[name] = FromJson(value);
    }
  }
  catch (const nlohmann::json::exception& error)
  {
    throw std::runtime_error(error.what());
  }
  return object;
}

std::vector<JsonOption> ParseJsonOptions(const std::string& text)
{
  std::vector<JsonOption> options;
  try
  {
    const nlohmann::json json = nlohmann::json::parse(text);
    if (!json.is_object())
    {
      throw std::runtime_error("it is not an object");
    }
    for (const auto& [name, value] : json.items())
    {
      const bool isList = value.is_array() && !value.empty() && !value[0].is_number();
      std::vector<std::string> texts;
      for (const nlohmann::json& item : isList ? value : nlohmann::json::array({ value }))
      {
        texts.push_back(FormatOption(name, item));
      }
      options.emplace_back(name, texts);
    }
  }
  catch (const nlohmann::json::exception& error)
  {
    throw std::runtime_error(error.what());
  }
  return options;
}

std::vector<std::pair<std::string, double>> ParseJsonSeries(const std::string& text)
{
  std::vector<std::pair<std::string, double>> files;
  try
  {
    double next = 0.0; // Entries without a time are numbered.
    const nlohmann::json series = nlohmann::json::parse(text);
    for (const nlohmann::json& entry : series.at("files"))
    {
      const bool isName = entry.is_string();
      const double time = isName ? next : entry.value("time", next);
      files.emplace_back(
        isName ? entry.get<std::string>() : entry.at("name").get<std::string>(), time);
      next = time + 1.0;
    }
  }
  catch (const nlohmann::json::exception& error)
  {
    throw std::runtime_error(error.what());
  }
  return files;
}

}
