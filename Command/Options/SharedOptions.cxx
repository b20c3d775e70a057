// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SharedOptions.h"

#include "Falloffs.h"

namespace penumbra
{

CLI::Option* AddProgressOption(CLI::App& app, std::string& progress)
{
  return AddChoice(app, "--progress", progress, { "auto", "bar", "plain", "none" },
    "Progress on stderr; auto: a bar on a terminal");
}

CLI::Option* AddGathererOption(CLI::App& app, std::string& gatherer, const std::string& note)
{
  return AddChoice(app, "--gatherer", gatherer, { "rays", "cube-map" },
    "How cache records sample the hemisphere: by rays or with OpenGL" + note);
}

CLI::Option* AddFalloffOption(
  CLI::App& app, const std::string& name, std::string& falloff, const std::string& note)
{
  return AddChoice(app, name, falloff, FalloffNames(),
    "Weight of an occluder at distance t: 1, 1 - t/R, 1 - (t/R)^2 or 1 - sqrt(t/R)" + note);
}

CLI::Option* AddOcclusionRadiusOption(
  CLI::App& app, const std::string& name, double& radius, const std::string& unlimited)
{
  return AddNumber(app, name, radius, "R",
    "Largest distance of an occluder in world units, " + unlimited +
      ": no limit; default: a tenth of the bounds' diagonal",
    { 0.0, Infinity, true, true })
    ->default_str("");
}

CLI::Option* AddStatisticsOption(CLI::App& app, std::string& path, const std::string& description)
{
  return app.add_option("--statistics", path, description)->type_name("FILE.json")->take_last();
}

}
