// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Options that several subcommands share.
#ifndef penumbra_SharedOptions_h
#define penumbra_SharedOptions_h

#include "Parsing/Arguments.h"

#include <string>

namespace penumbra
{

/// Adds --progress.
CLI::Option* AddProgressOption(CLI::App& app, std::string& progress);

/// Adds --gatherer. `note` follows the description.
CLI::Option* AddGathererOption(CLI::App& app, std::string& gatherer, const std::string& note = {});

/// Adds the option `name` for the falloff of ambient occlusion. `note` follows the description.
CLI::Option* AddFalloffOption(
  CLI::App& app, const std::string& name, std::string& falloff, const std::string& note = {});

/// Adds the option `name` for the radius of ambient occlusion. `unlimited`: what "inf" stands for.
CLI::Option* AddOcclusionRadiusOption(
  CLI::App& app, const std::string& name, double& radius, const std::string& unlimited);

/// Adds --statistics. `description` states what is written.
CLI::Option* AddStatisticsOption(CLI::App& app, std::string& path, const std::string& description);

}
#endif
