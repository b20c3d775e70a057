// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The subcommands. DeclareX() adds a subcommand and its options to the command line and returns the
// action that runs it.
#ifndef penumbra_Subcommands_h
#define penumbra_Subcommands_h

#include "Parsing/Program.h"

namespace penumbra
{

Action DeclareRender(const CommandLine& program);
Action DeclareAnimate(const CommandLine& program);
Action DeclareBake(const CommandLine& program);
Action DeclareChart(const CommandLine& program);
Action DeclareCompare(const CommandLine& program);
Action DeclareList(const CommandLine& program);
Action DeclareInfo(const CommandLine& program);

/// Replaces this process by the program `penumbra-chart` if the subcommand is `chart`. Returns for
/// other subcommands, and if the program is not found; it is not part of the installed package.
void ExecuteChartProgram(int argc, char** argv);

}
#endif
