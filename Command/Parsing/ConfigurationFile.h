// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Options from a file.
#ifndef penumbra_ConfigurationFile_h
#define penumbra_ConfigurationFile_h

#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace penumbra
{

/// Name of the option with the path of the file.
constexpr const char* ConfigurationOption = "--config";

/// If the arguments of the subcommand `command` contain --config, inserts the options of that file
/// which the arguments do not contain. Throws CommandError if the file cannot be read or has an
/// unknown option.
void InsertConfiguration(const CLI::App& command, std::vector<std::string>& arguments);

}
#endif
