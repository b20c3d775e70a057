// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>

int main(int argc, char** argv)
{
  CLI::App app("Penumbra: how much of it is visible?");
  CLI11_PARSE(app, argc, argv);
  return 0;
}
