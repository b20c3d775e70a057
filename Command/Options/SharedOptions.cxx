// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SharedOptions.h"

#include "Processes/CommandError.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace penumbra
{

namespace
{

/// In the order of vtkPenumbraIrradianceProvider::Falloffs.
const std::vector<std::string> Falloffs = { "none", "linear", "quadratic", "square-root" };

}

Option AddProgressOption(const CommandLine& app, std::string& progress)
{
  return AddChoice(app, "--progress", progress, { "auto", "bar", "plain", "none" },
    "Progress on stderr; auto: a bar on a terminal");
}

Option AddGathererOption(const CommandLine& app, std::string& gatherer, const std::string& note)
{
  return AddChoice(app, "--gatherer", gatherer, { "rays", "cube-map" },
    "How cache records sample the hemisphere: by rays or with OpenGL" + note);
}

int FindFalloff(const std::string& name)
{
  return static_cast<int>(std::find(Falloffs.begin(), Falloffs.end(), name) - Falloffs.begin());
}

Option AddFalloffOption(
  const CommandLine& app, const std::string& name, std::string& falloff, const std::string& note)
{
  return AddChoice(app, name, falloff, Falloffs,
    "Weight of an occluder at distance t: 1, 1 - t/R, 1 - (t/R)^2 or 1 - sqrt(t/R)" + note);
}

Option AddOcclusionRadiusOption(
  const CommandLine& app, const std::string& name, double& radius, const std::string& unlimited)
{
  return AddNumber(app, name, radius, "R",
    "Largest distance of an occluder in world units, " + unlimited +
      ": no limit; default: a tenth of the bounds' diagonal",
    { 0.0, Infinity, true, true })
    .Default("");
}

Option AddLightPositionOption(
  const CommandLine& app, LightPositions& lights, const std::string& description)
{
  const auto store = [&lights](const std::vector<std::string>& texts) {
    lights.clear();
    for (const std::string& text : texts)
    {
      std::vector<double> numbers = ParseNumbers("--light-position", text, 3, 4, Coordinate);
      numbers.resize(4, 1.0);
      lights.push_back({ numbers[0], numbers[1], numbers[2], numbers[3] });
    }
  };
  return app.AddRepeatable("--light-position", store, description).TypeName("X,Y,Z[,W]");
}

bool HasLight(const LightPositions& lights, bool positional)
{
  return std::any_of(lights.begin(), lights.end(),
    [positional](const std::array<double, 4>& light) { return (light[3] > 0.0) == positional; });
}

void RequireLightPositions(const LightPositions& lights)
{
  for (const std::array<double, 4>& light : lights)
  {
    const double length = std::max({ std::abs(light[0]), std::abs(light[1]), std::abs(light[2]) });
    if (light[3] < 0.0 || (light[3] == 0.0 && length == 0.0) ||
      (light[3] > 0.0 && length > light[3] * Coordinate.Maximum))
    {
      throw CommandError(
        BadInput, "--light-position: w must be positive, or 0 with a nonzero direction");
    }
  }
}

Option AddLightRadiusOption(const CommandLine& app, double& radius, const std::string& note)
{
  return AddNumber(app, "--light-radius", radius, "R",
    "Positional lights are spheres of this radius in world units" + note, { 0.0, 1e30 });
}

Option AddLightAngleOption(const CommandLine& app, double& angle, const std::string& note)
{
  return AddNumber(app, "--light-angle", angle, "DEG",
    "Angular diameter of directional lights (0.53 for the sun)" + note, { 0.0, 180.0 });
}

Option AddStatisticsOption(
  const CommandLine& app, std::string& path, const std::string& description)
{
  return app.AddText("--statistics", path, "FILE.json", description);
}

std::vector<std::string> DescribeIgnored(
  const CommandLine& app, const std::vector<IgnoredOption>& rows)
{
  std::vector<std::string> warnings;
  std::set<std::string> found;
  for (const IgnoredOption& row : rows)
  {
    if (row.IsIgnored && app.Count(row.Name) > 0 && found.insert(row.Name).second)
    {
      warnings.push_back(std::string(row.Name) + " has no effect " + row.Reason);
    }
  }
  return warnings;
}

}
