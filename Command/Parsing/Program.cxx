// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Program.h"

#include "Processes/CommandError.h"
#include "Processes/MallocSettings.h"
#include "Processes/MessageLog.h"
#include "Processes/Worker.h"

#include <CLI/CLI.hpp>

#include "vtkVersion.h"

#include <algorithm>
#include <csignal>
#include <iostream>
#include <map>

#include <fcntl.h>
#include <unistd.h>

namespace
{

using namespace penumbra;

// Converts an error of CLI11 to one line; unknown options and subcommands are named.
std::string DescribeError(const CLI::App& program, const CLI::ParseError& error)
{
  const std::vector<CLI::App*> chosen = program.get_subcommands();
  const std::string command = chosen.empty() ? "" : " " + chosen.front()->get_name();
  const std::string hint = "; see `penumbra" + command + " --help`";
  const std::vector<std::string> extras = program.remaining(true);
  const bool noSubcommand = dynamic_cast<const CLI::RequiredError*>(&error) && chosen.empty();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) || (noSubcommand && !extras.empty()))
  {
    const std::string first = extras.empty() ? "" : extras.front();
    const std::string option = first.substr(0, first.find('='));
    if (chosen.empty() && first.rfind('-', 0) != 0)
    {
      return first + ": unknown subcommand" + hint;
    }
    return option + ": unknown option" + hint;
  }
  if (noSubcommand)
  {
    return "no subcommand given" + hint;
  }
  return error.what() + hint;
}

// Opens /dev/null for each closed standard stream. Otherwise the next file opened would get its descriptor
// and messages would be written to an image. Writing to a closed standard output still fails.
void OccupyStandardStreams()
{
  for (const int stream : { STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO })
  {
    if (fcntl(stream, F_GETFD) < 0)
    {
      open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
    }
  }
}

int Run(int argc, char** argv, const std::vector<Subcommand>& subcommands)
{
  CLI::App program("Penumbra: fractional visibility for VTK: antialiased ray casting, ambient "
                   "occlusion, indirect light and light shafts",
    "penumbra");
  program.get_formatter()->column_width(44);
  program.set_version_flag("--version",
    std::string("penumbra ") + PENUMBRA_VERSION + " (VTK " + vtkVersion::GetVTKVersion() + ")");
  program.footer(
    "Exit status: 0 success, 1 comparison above its threshold, 2 invalid usage or input, 3 "
    "resource not available (OpenGL, memory).\nOptions of a subcommand: penumbra COMMAND --help");
  std::map<std::string, Action> actions;
  for (const Subcommand& subcommand : subcommands)
  {
    actions[subcommand.Name] = subcommand.Declare(program);
  }
  program.require_subcommand(1);
  try
  {
    program.parse(argc, argv);
  }
  catch (const CLI::Success& help)
  {
    program.exit(help, std::cout, std::cout);
    return Done;
  }
  catch (const CLI::ParseError& error)
  {
    throw CommandError(BadInput, DescribeError(program, error));
  }
  return actions.at(program.get_subcommands().front()->get_name())();
}

}

int penumbra::RunProgram(int argc, char** argv, const std::vector<Subcommand>& subcommands)
{
  OccupyStandardStreams();
  RetainFreedMemory();
  OpenLog();
  std::signal(SIGCHLD, SIG_DFL); // If ignored, waitpid() would not report exit statuses.
  std::signal(SIGXFSZ, SIG_IGN); // Writes beyond a quota then fail with an error code.
  try
  {
    return RunGuarded([&]() { return Run(argc, argv, subcommands); });
  }
  catch (const Cancelled& cancelled)
  {
    std::signal(cancelled.Signal, SIG_DFL);
    std::raise(cancelled.Signal); // The shell then reports the signal.
  }
  return Unavailable;
}
