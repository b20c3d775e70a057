// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Options that several subcommands share.
#ifndef penumbra_SharedOptions_h
#define penumbra_SharedOptions_h

#include "Parsing/Arguments.h"

#include <array>
#include <string>
#include <vector>

namespace penumbra
{

/// Coordinates whose squares are finite in double precision.
const Range Coordinate{ -1e100, 1e100 };

/// Adds --progress.
Option AddProgressOption(const CommandLine& app, std::string& progress);

/// Adds --gatherer. `note` follows the description.
Option AddGathererOption(
  const CommandLine& app, std::string& gatherer, const std::string& note = {});

/// Returns the falloff of a name that AddFalloffOption() accepts, of vtkPenumbraIrradianceProvider::Falloffs.
int FindFalloff(const std::string& name);

/// Adds the option `name` for the falloff of ambient occlusion. `note` follows the description.
Option AddFalloffOption(const CommandLine& app, const std::string& name, std::string& falloff,
  const std::string& note = {});

/// Adds the option `name` for the radius of ambient occlusion. `unlimited`: what "inf" stands for.
Option AddOcclusionRadiusOption(
  const CommandLine& app, const std::string& name, double& radius, const std::string& unlimited);

/// Lights as homogeneous positions; w = 0: a direction.
using LightPositions = std::vector<std::array<double, 4>>;

/// Adds --light-position, which may be repeated.
Option AddLightPositionOption(
  const CommandLine& app, LightPositions& lights, const std::string& description);

/// Returns true if a light has a position, or a direction.
bool HasLight(const LightPositions& lights, bool positional);

/// Throws CommandError unless w is positive, or 0 with a nonzero direction.
void RequireLightPositions(const LightPositions& lights);

///@{
/// Add --light-radius and --light-angle. `note` follows the description.
Option AddLightRadiusOption(const CommandLine& app, double& radius, const std::string& note = {});
Option AddLightAngleOption(const CommandLine& app, double& angle, const std::string& note = {});
///@}

/// Adds --statistics. `description` states what is written.
Option AddStatisticsOption(
  const CommandLine& app, std::string& path, const std::string& description);

/// A reason for which an option may have no effect.
struct IgnoredOption
{
  const char* Name;
  bool IsIgnored;
  const char* Reason;
};

/// Returns one warning for each option on the command line that has no effect, with the first of its reasons.
std::vector<std::string> DescribeIgnored(
  const CommandLine& app, const std::vector<IgnoredOption>& rows);

}
#endif
