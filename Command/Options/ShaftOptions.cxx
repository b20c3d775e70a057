// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ShaftOptions.h"

#include "Processes/CommandConstants.h"
#include "Processes/CommandError.h"

#include "vtkMath.h"
#include "vtkRenderer.h"

#include <cmath>

namespace penumbra
{

namespace
{

/// Adds an option with one coefficient for all channels, or three.
void AddCoefficients(const CommandLine& app, const std::string& name, std::vector<double>& target,
  const std::string& description)
{
  const auto store = [name, &target](const std::string& text) {
    const bool one = text.find(',') == std::string::npos;
    target = ParseNumbers(name, text, one ? 1 : 3, one ? 1 : 3, { 0.0, Infinity });
  };
  app.AddParsed(name, store, description).TypeName("S|R,G,B");
}

void AddPhase(const CommandLine& app, ShaftOptions& shafts)
{
  const auto store = [&shafts](const std::string& text) {
    shafts.Phase = text.substr(0, 3) == "hg:" ? "hg" : text;
    if (shafts.Phase == "hg")
    {
      shafts.Asymmetry = ParseNumbers("--shafts-phase", text.substr(3), 1, 1, { -0.999, 0.999 })[0];
    }
    else if (text != "isotropic" && text != "rayleigh")
    {
      throw InvalidValue(
        "--shafts-phase", "'" + text + "' is not one of isotropic, rayleigh, hg:G");
    }
  };
  app
    .AddParsed("--shafts-phase", store,
      "Phase function of --shafts-scattering; hg: Henyey-Greenstein, G from -0.999 (backward) to "
      "0.999 (forward)")
    .TypeName("isotropic|rayleigh|hg:G")
    .Default("isotropic");
}

double Of(const std::vector<double>& coefficients, std::size_t channel)
{
  return coefficients.size() == 1 ? coefficients[0] : coefficients[channel];
}

}

const std::vector<std::string>& ShaftOptions::GetNames()
{
  static const std::vector<std::string> names = { "--shafts-scattering", "--shafts-extinction",
    "--shafts-rayleigh", "--shafts-phase", "--shafts-scale-height", "--shafts-base-height",
    "--shafts-up", "--shafts-density", "--shafts-surface-light", "--shafts-behind-translucent",
    "--shafts-estimator" };
  return names;
}

double FindLowestHeight(vtkRenderer* renderer, const Vector3& up)
{
  double bounds[6];
  renderer->ComputeVisiblePropBounds(bounds);
  double height = 0.0;
  for (int axis = 0; axis < 3 && vtkMath::AreBoundsInitialized(bounds); ++axis)
  {
    height += up[axis] * bounds[2 * axis + (up[axis] > 0.0 ? 0 : 1)];
  }
  return height / std::hypot(up[0], up[1], up[2]);
}

void DeclareShaftOptions(const CommandLine& app, ShaftOptions& shafts)
{
  app.AddFlag("--light-shafts", shafts.Enabled,
    "Medium (haze) in which lights (--light-position) cast visible shafts");
  AddCoefficients(app, "--shafts-scattering", shafts.Scattering,
    "Scattering coefficient per world unit, of all colors or of red, green and blue; default: 0.25 "
    "divided by the diagonal of the bounds");
  AddCoefficients(app, "--shafts-extinction", shafts.Extinction,
    "Extinction coefficient per world unit, --shafts-scattering included; default: no absorption");
  AddNumber(app, "--shafts-rayleigh", shafts.Rayleigh, "S",
    "Scattering coefficient of small particles in green, in addition; 0.43 of it in red, 2.44 in "
    "blue: blue haze, red suns",
    { 0.0, Infinity });
  AddPhase(app, shafts);
  AddNumber(app, "--shafts-scale-height", shafts.ScaleHeight, "H",
    "Height in world units over which the density falls to 1/e; 0: the same density everywhere",
    { 0.0, Infinity });
  AddNumber(app, "--shafts-base-height", shafts.BaseHeight, "Y",
    "Height at which the coefficients hold; default: the lowest point of the bounds")
    .Default("");
  AddDirection(
    app, "--shafts-up", shafts.Up, "Direction in which heights are measured; default: 0,1,0");
  app.AddText("--shafts-density", shafts.Density, "FILE",
    "Image data (.vti, .vtk, ...) with the relative density as point scalars; 0 outside (ray)");
  AddChoice(app, "--shafts-surface-light", shafts.SurfaceLight,
    { "automatic", "attenuated", "unattenuated" },
    "Light on its way to surfaces; automatic: attenuated, unless the medium is gray and its "
    "density the same everywhere (ray)");
  app.AddFlag("--shafts-behind-translucent", shafts.BehindTranslucent,
    "Translucent surfaces stand in front of the medium (ray; raster: always)");
  AddChoice(app, "--shafts-estimator", shafts.Estimator, { "depth", "shadow-map" },
    "Shadows of the shafts: from the depth of the image, or from a shadow map of each light, whose "
    "error follows --tolerance (raster)");
}

void CheckShaftOptions(const ShaftOptions& shafts)
{
  for (std::size_t i = 0; i < 3 && !shafts.Scattering.empty() && !shafts.Extinction.empty(); ++i)
  {
    if (Of(shafts.Extinction, i) < Of(shafts.Scattering, i))
    {
      throw CommandError(BadInput,
        "--shafts-extinction must not be less than --shafts-scattering, which it includes");
    }
  }
}

}
