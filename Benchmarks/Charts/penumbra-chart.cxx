// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The program `penumbra-chart`, which `penumbra chart` starts.
#include "Chart.h"
#include "Parsing/Program.h"
#include "Processes/EndProcess.h"

#include <string>
#include <vector>

int main(int argc, char** argv)
{
  std::string program = "penumbra";
  std::string subcommand = "chart";
  std::vector<char*> arguments = { program.data(), subcommand.data() };
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  arguments.push_back(nullptr);
  penumbra::EndProcess(penumbra::RunProgram(static_cast<int>(arguments.size()) - 1,
    arguments.data(), { { "chart", penumbra::DeclareChart } }));
}
