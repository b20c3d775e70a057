// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The subcommand `chart`.
#ifndef penumbra_Chart_h
#define penumbra_Chart_h

#include "Parsing/Program.h"

namespace penumbra
{

Action DeclareChart(const CommandLine& program);

}
#endif
