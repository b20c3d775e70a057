// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The command line: subcommands and their options. Only CommandLine.cxx includes CLI11, which takes
// seconds to compile.
#ifndef penumbra_CommandLine_h
#define penumbra_CommandLine_h

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace CLI
{
class App;
class Option;
}

namespace penumbra
{

/// A value that an option does not accept. what(): "OPTION: MESSAGE".
class InvalidValue : public std::runtime_error
{
public:
  InvalidValue(const std::string& option, const std::string& message)
    : std::runtime_error(option + ": " + message)
  {
  }
};

/// A declared option. Refers to the command line.
class Option
{
public:
  explicit Option(CLI::Option* option)
    : Implementation(option)
  {
  }

  ///@{
  /// Text of the help: the value of the option, its default and description.
  Option TypeName(const std::string& name) const;
  Option Default(const std::string& value) const;
  Option Description(const std::string& text) const;
  ///@}

  /// The option must be given.
  Option Required() const;

  /// Calls `listener` with each value.
  Option Each(const std::function<void(const std::string& value)>& listener) const;

private:
  CLI::Option* Implementation;
};

/// The program or a subcommand. Refers to the Parser.
class CommandLine
{
public:
  explicit CommandLine(CLI::App* app)
    : Implementation(app)
  {
  }

  CommandLine AddSubcommand(const std::string& name, const std::string& description) const;

  /// Sets the heading of the options that are added next in the help; empty: they are hidden.
  void SetGroup(const std::string& heading) const;

  ///@{
  /// Adds an option, or an argument if `name` has no dashes. If an option with one value is repeated, the last one
  /// counts. Targets must outlive the parser.
  Option AddText(const std::string& name, std::string& target, const std::string& typeName,
    const std::string& description) const;
  Option AddTexts(const std::string& name, std::vector<std::string>& target,
    const std::string& description) const;
  ///@}

  /// Adds an option whose value `store` parses; throws InvalidValue.
  Option AddParsed(const std::string& name,
    const std::function<void(const std::string& text)>& store,
    const std::string& description) const;

  /// Adds an option that may be repeated; `store` gets all values.
  Option AddRepeatable(const std::string& name,
    const std::function<void(const std::vector<std::string>& texts)>& store,
    const std::string& description) const;

  /// Adds an option that may be repeated; `store` gets each value while the command line is parsed, so
  /// that several options keep their order.
  Option AddOrdered(const std::string& name,
    const std::function<void(const std::string& text)>& store,
    const std::string& description) const;

  ///@{
  /// Adds a flag that sets `target` to true, or to false.
  Option AddFlag(const std::string& name, bool& target, const std::string& description) const;
  Option AddNegation(const std::string& name, bool& target, const std::string& description) const;
  ///@}

  /// Adds a hidden option with an optional value ("--name=value").
  Option AddIgnored(const std::string& name, std::string& value) const;

  /// Returns a declared option.
  Option Get(const std::string& name) const;

  void Remove(const std::string& name) const;

  /// Returns how often an option was given.
  std::size_t Count(const std::string& name) const;

  /// Returns all options with their values, one "name=value" per line.
  std::string Describe() const;

  /// Accepts any arguments, --help included, for another program.
  void AcceptAnything() const;

private:
  CLI::App* Implementation;
};

/// Returns the visible option of `command` that the unknown `option` may mean, both with dashes; or "".
std::string FindSimilarOption(const CLI::App& command, const std::string& option);

/// Parses a command line that consists of a subcommand and its options.
class Parser
{
public:
  Parser(const std::string& name, const std::string& description, const std::string& version,
    const std::string& footer);
  ~Parser();

  CommandLine GetProgram() const;

  /// Returns the name of the subcommand; empty if only help or the version was printed. Throws
  /// CommandError.
  std::string Parse(int argc, char** argv) const;

private:
  std::unique_ptr<CLI::App> Implementation;
};

}
#endif
