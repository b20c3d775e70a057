// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ConfigurationFile.h"

#include "Files/InputFiles.h"
#include "Files/JsonObject.h"
#include "Processes/CommandError.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>

namespace penumbra
{

namespace
{

using Arguments = std::vector<std::string>;

/// Returns the number of insertions, deletions and replacements between two texts.
std::size_t ComputeDistance(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j)
  {
    row[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({ row[j] + 1, row[j - 1] + 1, replaced });
    }
  }
  return row[b.size()];
}

std::string FindNearestName(const CLI::App& app, const std::string& name)
{
  std::string nearest;
  std::size_t least = std::string::npos;
  for (const CLI::Option* option : app.get_options())
  {
    for (const std::string& candidate : option->get_lnames())
    {
      const std::size_t distance = ComputeDistance(name, candidate);
      if (distance < least)
      {
        least = distance;
        nearest = candidate;
      }
    }
  }
  return nearest;
}

/// Returns the path of --config; empty: the option is not given.
std::string FindPath(const Arguments& arguments)
{
  const std::string option = ConfigurationOption;
  std::string path;
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

void InsertConfiguration(const CLI::App& program, Arguments& arguments)
{
  const auto subcommands = program.get_subcommands([](const CLI::App*) { return true; });
  const auto chosen = std::find_if(subcommands.begin(), subcommands.end(),
    [&](const CLI::App* app) { return !arguments.empty() && app->get_name() == arguments[0]; });
  if (chosen == subcommands.end() || !(*chosen)->get_option_no_throw(ConfigurationOption))
  {
    return;
  }
  const std::string path = FindPath(arguments);
  if (path.empty())
  {
    return;
  }
  const CLI::App& app = **chosen;
  const std::string prefix = std::string(ConfigurationOption) + " " + path + ": ";
  const std::set<const CLI::Option*> given = FindGivenOptions(app, arguments);
  Arguments inserted;
  for (const auto& [name, values] : ReadOptions(path, prefix))
  {
    const std::string longName = "--" + name;
    const CLI::Option* option = app.get_option_no_throw(longName);
    if (!option || longName == ConfigurationOption || longName == "--help")
    {
      throw CommandError(BadInput,
        prefix + "'" + name + "' is not an option of this file; the nearest name is '" +
          FindNearestName(app, name) + "'");
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
