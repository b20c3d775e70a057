// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Json.h"

#include <nlohmann/json.hpp>

#include <limits>

namespace penumbra_testing
{

class JsonReader
{
public:
  static Json Convert(const nlohmann::json& value)
  {
    Json converted;
    if (value.is_object())
    {
      for (const auto& [name, member] : value.items())
      {
        converted.Members[name] = std::make_shared<Json>(Convert(member));
      }
    }
    else if (value.is_string())
    {
      converted.IsText = true;
      converted.Text = value.get<std::string>();
    }
    else if (value.is_boolean())
    {
      converted.Number = value.get<bool>() ? 1.0 : 0.0;
    }
    else
    {
      converted.Number =
        value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
    }
    return converted;
  }
};

Json Json::Parse(const std::string& text)
{
  return JsonReader::Convert(nlohmann::json::parse(text));
}

const Json& Json::operator[](const std::string& name) const
{
  return *this->Members.at(name);
}

std::size_t Json::GetSize() const
{
  return this->Members.size();
}

}
