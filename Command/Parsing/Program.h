// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Common body of main(): parses the command line, runs one subcommand, and converts every error to
// one line on stderr and an exit status.
#ifndef penumbra_Program_h
#define penumbra_Program_h

#include <functional>
#include <vector>

namespace penumbra
{

class CommandLine;

/// Runs a subcommand; returns an exit status or throws CommandError.
using Action = std::function<int()>;

/// A subcommand. Declare() adds the subcommand and its options to the command line.
struct Subcommand
{
  const char* Name;
  Action (*Declare)(const CommandLine& program);
};

/// Runs the program; returns the exit status.
int RunProgram(int argc, char** argv, const std::vector<Subcommand>& subcommands);

}
#endif
