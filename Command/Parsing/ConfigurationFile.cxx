// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConfigurationFile.h"

#include "CommandLine.h"
#include "Files/InputFiles.h"
#include "Files/JsonObject.h"
#include "Processes/CommandError.h"

#include <CLI/CLI.hpp>

#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <stdexcept>

namespace penumbra
{

namespace
{

using Arguments = std::vector<std::string>;

/// Returns the path of --config if the option is given.
std::optional<std::string> FindPath(const Arguments& arguments)
{
  const std::string option = ConfigurationOption;
  std::optional<std::string> path;
  for (std::size_t i = 0; i < arguments.size(); ++i)
  {
    if (arguments[i] == option && i + 1 < arguments.size())
    {
      path = arguments[i + 1];
    }
    else if (arguments[i].rfind(option + "=", 0) == 0)
    {
      path = arguments[i].substr(option.size() + 1);
    }
  }
  return path;
}

/// Returns the options that `arguments` contain.
std::set<const CLI::Option*> FindGivenOptions(const CLI::App& app, const Arguments& arguments)
{
  std::set<const CLI::Option*> given;
  for (const std::string& argument : arguments)
  {
    if (argument.size() < 2 || argument[0] != '-')
    {
      continue;
    }
    if (argument[1] == '-')
    {
      given.insert(app.get_option_no_throw(argument.substr(0, argument.find('='))));
      continue;
    }
    for (std::size_t i = 1; i < argument.size(); ++i) // -sb
    {
      given.insert(app.get_option_no_throw(std::string("-") + argument[i]));
    }
  }
  return given;
}

std::vector<JsonOption> ReadOptions(const std::string& path, const std::string& name)
{
  std::ifstream file(path, std::ios::binary);
  if (!file)
  {
    throw CommandError(BadInput, name + "no such file; check the name");
  }
  RecordInput(path);
  try
  {
    return ParseJsonOptions({ std::istreambuf_iterator<char>(file), {} });
  }
  catch (const std::runtime_error& error)
  {
    throw CommandError(BadInput,
      name + "the file must contain a JSON object of options by their long names: " + error.what());
  }
}

}

void InsertConfiguration(const CLI::App& command, Arguments& arguments)
{
  if (!command.get_option_no_throw(ConfigurationOption))
  {
    return;
  }
  const std::optional<std::string> path = FindPath(arguments);
  if (!path)
  {
    return;
  }
  const std::string prefix = std::string(ConfigurationOption) + " " + *path + ": ";
  const std::set<const CLI::Option*> given = FindGivenOptions(command, arguments);
  Arguments inserted;
  for (const auto& [name, values] : ReadOptions(*path, prefix))
  {
    const std::string longName = "--" + name;
    const CLI::Option* option = command.get_option_no_throw(longName);
    if (!option || longName == ConfigurationOption || longName == "--help")
    {
      const std::string similar = option ? "" : FindSimilarOption(command, longName);
      throw CommandError(BadInput,
        prefix + "'" + name + "' is not an option of this file; " +
          (similar.empty() ? "see `penumbra " + command.get_name() + " --help`"
                           : "the nearest name is '" + similar.substr(2) + "'"));
    }
    if (given.count(option) > 0)
    {
      continue;
    }
    for (const std::string& value : values)
    {
      if (option->get_items_expected_max() > 0)
      {
        inserted.push_back(longName + "=" + value);
      }
      else if (value == "true")
      {
        inserted.push_back(longName);
      }
      else if (value != "false")
      {
        throw CommandError(BadInput, prefix + "'" + name + "' must be true or false");
      }
    }
  }
  arguments.insert(arguments.begin() + 1, inserted.begin(), inserted.end());
}

}
