// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The program `penumbra`.
#include "Parsing/Program.h"
#include "Processes/EndProcess.h"
#include "Subcommands.h"

int main(int argc, char** argv)
{
  using namespace penumbra;
  ExecuteChartProgram(argc, argv);
  EndProcess(RunProgram(argc, argv,
    { { "render", DeclareRender }, { "animate", DeclareAnimate }, { "bake", DeclareBake },
      { "chart", DeclareChart }, { "compare", DeclareCompare }, { "list", DeclareList },
      { "info", DeclareInfo } }));
}
