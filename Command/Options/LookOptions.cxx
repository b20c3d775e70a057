// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LookOptions.h"

#include "RenderOptions.h"

#include <algorithm>

namespace penumbra
{

namespace
{

/// Angular diameter of the sun, in degrees. The real one, 0.5, gives shadows whose penumbrae are
/// narrower than a pixel in most images.
constexpr double SunAngle = 3.0;

const std::vector<Look>& Looks()
{
  static const std::vector<Look> looks = {
    { "plain", {} },
    { "studio",
      { { -35.0, 40.0, { 0.87, 0.86, 0.84 } }, { 45.0, 8.0, { 0.28, 0.30, 0.33 } },
        { 165.0, 35.0, { 0.25, 0.25, 0.25 } } },
      30.0, 20.0 },
    { "outdoor", { { -35.0, 42.0, { 0.82, 0.76, 0.67 } } }, 30.0, 24.0 },
    { "figure", { { -30.0, 35.0, { 0.82, 0.82, 0.82 } }, { 35.0, 5.0, { 0.33, 0.33, 0.33 } } },
      30.0, 22.0 },
    { "clay", { { -30.0, 40.0, { 0.98, 0.97, 0.95 } }, { 50.0, 5.0, { 0.32, 0.33, 0.35 } } }, 30.0,
      18.0 },
  };
  return looks;
}

/// Sets options that are not on the command line.
class Defaults
{
public:
  explicit Defaults(const CommandLine& app)
    : App(app)
  {
  }

  template <typename Value, typename New>
  void Set(const char* option, Value& value, const New& newValue) const
  {
    if (this->App.Count(option) == 0)
    {
      value = newValue;
    }
  }

private:
  const CommandLine& App;
};

void ApplyOcclusion(const Defaults& defaults, double strength, RenderOptions& options)
{
  defaults.Set("--ambient-occlusion", options.AmbientOcclusion, true);
  // Colors of data keep the default strength.
  if (!options.Coloring.Enabled)
  {
    defaults.Set("--ambient-occlusion-strength", options.AmbientOcclusionStrength, strength);
  }
}

}

std::vector<std::string> LookNames()
{
  std::vector<std::string> names;
  for (const Look& look : Looks())
  {
    names.push_back(look.Name);
  }
  return names;
}

const Look& FindLook(const std::string& name)
{
  return *std::find_if(
    Looks().begin(), Looks().end(), [&](const Look& look) { return look.Name == name; });
}

void ApplyLook(const CommandLine& app, RenderOptions& options)
{
  const Defaults defaults(app);
  const auto setBackground = [&](const Vector3& color) {
    defaults.Set("--background-color", options.BackgroundColor, color);
  };
  const bool ray = options.Engine == "ray";
  if (options.Look == "studio")
  {
    setBackground({ 0.89, 0.90, 0.92 });
    ApplyOcclusion(defaults, 0.85, options);
  }
  else if (options.Look == "outdoor")
  {
    setBackground({ 0.74, 0.83, 0.92 });
    if (ray)
    {
      defaults.Set("--shadows", options.Shadows, true);
      defaults.Set("--light-angle", options.LightAngle, SunAngle);
      defaults.Set("--indirect", options.Light.Indirect, true);
      defaults.Set(
        "--environment-color", options.Light.EnvironmentColor, Vector3{ 0.32, 0.42, 0.58 });
      defaults.Set("--bounces", options.Light.Bounces, 2);
    }
    else
    {
      ApplyOcclusion(defaults, 0.8, options);
    }
  }
  else if (options.Look == "figure")
  {
    setBackground({ 1.0, 1.0, 1.0 });
    defaults.Set("--camera-orthographic", options.Camera.Orthographic, true);
    defaults.Set("--outline-width", options.OutlineWidth, 0.5);
    ApplyOcclusion(defaults, 0.7, options);
  }
  else if (options.Look == "clay")
  {
    setBackground({ 0.93, 0.92, 0.90 });
    defaults.Set("--no-materials", options.Materials, false);
    defaults.Set("--color", options.Color, Vector3{ 0.86, 0.77, 0.69 });
    ApplyOcclusion(defaults, 1.0, options);
  }
}

}
