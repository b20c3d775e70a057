// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Runs a program of subcommands: parses the command line, runs one subcommand, and turns every failure
// into one line on stderr and an exit status.
#ifndef penumbra_Program_h
#define penumbra_Program_h

#include <functional>
#include <vector>

namespace CLI
{
class App;
}

namespace penumbra
{

/// The work of a subcommand; returns an exit status or throws Failure.
using Action = std::function<int()>;

/// Declare() adds the subcommand and its options to the command line.
struct Subcommand
{
  const char* Name;
  Action (*Declare)(CLI::App& program);
};

/// The body of main(): returns the exit status.
int RunProgram(int argc, char** argv, const std::vector<Subcommand>& subcommands);

}
#endif
