// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// penumbra chart: starts the program penumbra-chart, as git starts the programs of its subcommands. The
// charts use the references and scenes of the benchmarks, which the installed program does not contain.
#include "Parsing/CommandLine.h"
#include "Processes/CommandError.h"
#include "Subcommands.h"

#include <filesystem>
#include <string>
#include <vector>

#include <unistd.h>

namespace penumbra
{

void ExecuteChartProgram(int argc, char** argv)
{
  if (argc < 2 || std::string(argv[1]) != "chart")
  {
    return;
  }
  const char* name = "penumbra-chart";
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::string sibling = (self.parent_path() / name).string();
  std::string program = name;
  std::vector<char*> arguments = { program.data() };
  arguments.insert(arguments.end(), argv + 2, argv + argc);
  arguments.push_back(nullptr);
  execv(sibling.c_str(), arguments.data());
  execvp(name, arguments.data());
}

Action DeclareChart(const CommandLine& program)
{
  const CommandLine app =
    program.AddSubcommand("chart", "Measure and plot speed against accuracy of every method");
  app.AcceptAnything();
  return []() -> int {
    throw CommandError(Unavailable,
      "chart: the program penumbra-chart is neither next to penumbra nor in PATH; it is built with "
      "the benchmarks (BUILD_TESTING=ON, PENUMBRA_BUILD_BENCHMARKS=ON)");
  };
}

}
