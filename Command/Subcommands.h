// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The subcommands. Each declares its options on its part of the command line and, when chosen,
// does its work and returns an exit status.
#ifndef penumbra_Subcommands_h
#define penumbra_Subcommands_h

#include "Parsing/Program.h"

namespace penumbra
{

Action DeclareRender(CLI::App& program);
Action DeclareAnimate(CLI::App& program);
Action DeclareBake(CLI::App& program);
Action DeclareChart(CLI::App& program);
Action DeclareCompare(CLI::App& program);
Action DeclareList(CLI::App& program);
Action DeclareInfo(CLI::App& program);

/// If the subcommand is `chart`, replaces this process by the program `penumbra-chart`, which is not
/// part of the installed package. Returns for any other subcommand, and if there is no such program.
void ExecuteChartProgram(int argc, char** argv);

}
#endif
