// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The subcommands. Each declares its options on its part of the command line and, when chosen,
// does its work and returns an exit status.
#ifndef penumbra_Subcommands_h
#define penumbra_Subcommands_h

#include <functional>

namespace CLI
{
class App;
}

namespace penumbra
{

using Action = std::function<int()>;

Action DeclareRender(CLI::App& program);
Action DeclareAnimate(CLI::App& program);
Action DeclareBake(CLI::App& program);
Action DeclareChart(CLI::App& program);
Action DeclareCompare(CLI::App& program);
Action DeclareList(CLI::App& program);
Action DeclareInfo(CLI::App& program);

}
#endif
