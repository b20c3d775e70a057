// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CommandLine.h"

#include "ConfigurationFile.h"
#include "ForeignOptions.h"
#include "Processes/CommandError.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <numeric>
#include <utility>
#include <vector>

namespace penumbra
{

namespace
{

/// Returns the number of characters to be inserted, removed or replaced to make one word of the other.
std::size_t CountEdits(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t(0));
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j)
    {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = std::exchange(row[j + 1], std::min({ replaced, row[j] + 1, row[j + 1] + 1 }));
    }
  }
  return row.back();
}

/// Returns the name that is one or two edits from `word`, or the shortest one that begins with it or has a word that
/// does; or "".
std::string FindSimilar(const std::vector<std::string>& names, const std::string& word)
{
  if (word.size() < 3)
  {
    return "";
  }
  const std::size_t mostEdits = word.size() < 6 ? 1 : 2;
  const auto rank = [&](const std::string& name) {
    const std::size_t edits = CountEdits(name, word);
    const std::size_t inside = name.find("-" + word);
    return edits <= mostEdits                   ? edits
      : name.compare(0, word.size(), word) == 0 ? name.size()
      : inside != std::string::npos             ? name.size() + 4 * inside
                                                : inside;
  };
  const auto best = std::min_element(names.begin(), names.end(),
    [&](const std::string& a, const std::string& b) { return rank(a) < rank(b); });
  return best == names.end() || rank(*best) == std::string::npos ? std::string() : *best;
}

/// Returns what an unknown subcommand may mean, or "".
std::string FindSimilarSubcommand(const CLI::App& program, const std::string& word)
{
  if (program.get_option_no_throw("--" + word))
  {
    return "--" + word;
  }
  std::vector<std::string> names;
  for (const CLI::App* subcommand : program.get_subcommands({}))
  {
    names.push_back(subcommand->get_name());
  }
  return FindSimilar(names, word);
}

/// Returns the hidden option without its value, whose name is missing in the error of CLI11, or "".
std::string FindHiddenOption(const CLI::App& command, const std::vector<std::string>& arguments)
{
  for (const std::string& argument : arguments)
  {
    const std::size_t end = argument.find('=');
    const bool isEmpty =
      end == std::string::npos ? &argument == &arguments.back() : end + 1 == argument.size();
    const std::string name = argument.substr(0, end);
    const CLI::Option* option =
      isEmpty && name.rfind("--", 0) == 0 ? command.get_option_no_throw(name) : nullptr;
    if (option && option->get_group().empty() && option->get_items_expected_min() > 0)
    {
      return name;
    }
  }
  return "";
}

/// Returns the subcommand that the arguments begin with, or nullptr.
const CLI::App* FindSubcommand(const CLI::App& program, const std::vector<std::string>& arguments)
{
  const auto subcommands = program.get_subcommands([](const CLI::App*) { return true; });
  const auto chosen = std::find_if(subcommands.begin(), subcommands.end(),
    [&](const CLI::App* app) { return !arguments.empty() && app->get_name() == arguments[0]; });
  return chosen == subcommands.end() ? nullptr : *chosen;
}

/// Makes two arguments of --NAME= where CLI11 would take the next argument as the value.
void SeparateEmptyValues(const CLI::App& command, std::vector<std::string>& arguments)
{
  for (std::size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i)
  {
    const std::string name = arguments[i].substr(0, arguments[i].find('='));
    const CLI::Option* option =
      name.rfind("--", 0) == 0 ? command.get_option_no_throw(name) : nullptr;
    if (!option || option->get_items_expected_max() == 0)
    {
      continue;
    }
    if (arguments[i].size() == name.size() + 1)
    {
      arguments[i] = name;
      arguments.insert(arguments.begin() + static_cast<std::ptrdiff_t>(i) + 1, std::string());
    }
    i += arguments[i] == name ? 1 : 0; // the value
  }
}

// Converts an error of CLI11 to one line; unknown options and subcommands are named.
std::string DescribeError(
  const CLI::App& program, const std::vector<std::string>& arguments, const std::exception& error)
{
  const std::vector<CLI::App*> chosen = program.get_subcommands();
  const std::string command = chosen.empty() ? "" : " " + chosen.front()->get_name();
  const std::string help = "see `penumbra" + command + " --help`";
  const std::string hint = "; " + help;
  const auto suggest = [&](const std::string& similar) {
    return similar.empty() ? hint : "; did you mean " + similar + "? Otherwise " + help;
  };
  const std::vector<std::string> extras = program.remaining(true);
  const std::string first = extras.empty() ? "" : extras.front();
  const bool isOption = first.rfind('-', 0) == 0;
  const bool missing = dynamic_cast<const CLI::RequiredError*>(&error);
  if (missing && chosen.empty() && extras.empty())
  {
    return "no subcommand given" + hint;
  }
  if (chosen.empty() && !extras.empty() && !isOption)
  {
    return first + ": unknown subcommand" + suggest(FindSimilarSubcommand(program, first));
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error) && !isOption)
  {
    return first + ": unexpected argument" + hint;
  }
  // What is missing may be missing because of an option that is misspelled.
  if (dynamic_cast<const CLI::ExtrasError*>(&error) || (missing && isOption))
  {
    const std::string option = FindShortOption(first.substr(0, first.find('=')));
    const bool renders = command == " render" || command == " animate";
    const std::string replacement = renders ? FindReplacement(option) : std::string();
    if (!replacement.empty())
    {
      return option + ": an option of F3D; " + replacement + hint;
    }
    return option + ": unknown option" +
      suggest(FindSimilarOption(chosen.empty() ? program : *chosen.front(), option));
  }
  const bool isUnnamed =
    !chosen.empty() && dynamic_cast<const CLI::ArgumentMismatch*>(&error) && error.what()[0] == ':';
  return (isUnnamed ? FindHiddenOption(*chosen.front(), arguments) : "") + error.what() + hint;
}

}

std::string FindSimilarOption(const CLI::App& command, const std::string& option)
{
  std::vector<std::string> names;
  for (const CLI::Option* known : command.get_options())
  {
    if (!known->get_group().empty()) // hidden otherwise
    {
      names.insert(names.end(), known->get_lnames().begin(), known->get_lnames().end());
    }
  }
  const bool isLong = option.rfind("--", 0) == 0;
  const std::string similar = isLong ? FindSimilar(names, option.substr(2)) : "";
  return similar.empty() ? "" : "--" + similar;
}

Option Option::TypeName(const std::string& name) const
{
  this->Implementation->type_name(name);
  return *this;
}

Option Option::Default(const std::string& value) const
{
  this->Implementation->default_str(value);
  return *this;
}

Option Option::Description(const std::string& text) const
{
  this->Implementation->description(text);
  return *this;
}

Option Option::Required() const
{
  this->Implementation->required();
  return *this;
}

Option Option::Each(const std::function<void(const std::string& value)>& listener) const
{
  this->Implementation->each(listener);
  return *this;
}

CommandLine CommandLine::AddSubcommand(
  const std::string& name, const std::string& description) const
{
  return CommandLine(this->Implementation->add_subcommand(name, description));
}

void CommandLine::SetGroup(const std::string& heading) const
{
  this->Implementation->option_defaults()->group(heading);
}

Option CommandLine::AddText(const std::string& name, std::string& target,
  const std::string& typeName, const std::string& description) const
{
  CLI::Option* option =
    this->Implementation->add_option(name, target, description)->type_name(typeName);
  return Option(name[0] == '-' ? option->take_last() : option);
}

Option CommandLine::AddTexts(
  const std::string& name, std::vector<std::string>& target, const std::string& description) const
{
  return Option(this->Implementation->add_option(name, target, description));
}

Option CommandLine::AddParsed(const std::string& name,
  const std::function<void(const std::string& text)>& store, const std::string& description) const
{
  return Option(
    this->Implementation->add_option_function<std::string>(name, store, description)->take_last());
}

Option CommandLine::AddRepeatable(const std::string& name,
  const std::function<void(const std::vector<std::string>& texts)>& store,
  const std::string& description) const
{
  return Option(
    this->Implementation->add_option_function<std::vector<std::string>>(name, store, description)
      ->allow_extra_args(false));
}

Option CommandLine::AddOrdered(const std::string& name,
  const std::function<void(const std::string& text)>& store, const std::string& description) const
{
  return Option(this->Implementation->add_option_function<std::string>(name, store, description)
                  ->trigger_on_parse()
                  ->take_last());
}

Option CommandLine::AddFlag(
  const std::string& name, bool& target, const std::string& description) const
{
  return Option(this->Implementation->add_flag(name, target, description));
}

Option CommandLine::AddNegation(
  const std::string& name, bool& target, const std::string& description) const
{
  const auto store = [&target](std::int64_t uses) { target = uses <= 0; };
  return Option(this->Implementation->add_flag_function(name, store, description));
}

Option CommandLine::AddIgnored(const std::string& name, std::string& value) const
{
  return Option(this->Implementation->add_flag(name, value)->group(""));
}

Option CommandLine::Get(const std::string& name) const
{
  return Option(this->Implementation->get_option(name));
}

void CommandLine::Remove(const std::string& name) const
{
  this->Implementation->remove_option(this->Implementation->get_option(name));
}

std::size_t CommandLine::Count(const std::string& name) const
{
  return this->Implementation->count(name);
}

std::string CommandLine::Describe() const
{
  return this->Implementation->config_to_str(true, false);
}

void CommandLine::AcceptAnything() const
{
  this->Implementation->prefix_command();
  this->Implementation->set_help_flag();
}

Parser::Parser(const std::string& name, const std::string& description, const std::string& version,
  const std::string& footer)
  : Implementation(std::make_unique<CLI::App>(description, name))
{
  this->Implementation->get_formatter()->column_width(44);
  this->Implementation->set_version_flag("--version", version);
  this->Implementation->footer(footer);
  this->Implementation->require_subcommand(1);
}

Parser::~Parser() = default;

CommandLine Parser::GetProgram() const
{
  return CommandLine(this->Implementation.get());
}

std::string Parser::Parse(int argc, char** argv) const
{
  std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  try
  {
    if (const CLI::App* command = FindSubcommand(*this->Implementation, arguments))
    {
      InsertConfiguration(*command, arguments);
      SeparateEmptyValues(*command, arguments);
    }
    // The order that CLI11 expects.
    this->Implementation->parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  }
  catch (const CLI::Success& help)
  {
    this->Implementation->exit(help, std::cout, std::cout);
    return {};
  }
  catch (const CLI::ParseError& error)
  {
    throw CommandError(BadInput, DescribeError(*this->Implementation, arguments, error));
  }
  catch (const InvalidValue& error)
  {
    throw CommandError(BadInput, DescribeError(*this->Implementation, arguments, error));
  }
  return this->Implementation->get_subcommands().front()->get_name();
}

}
