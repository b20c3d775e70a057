// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Named combinations of background, lights, camera and effects: --look.
#ifndef penumbra_LookOptions_h
#define penumbra_LookOptions_h

#include <array>
#include <string>
#include <vector>

namespace penumbra
{

class CommandLine;
struct RenderOptions;

/// A directional light relative to the camera, in degrees: azimuth to the right of the direction to
/// the camera, elevation above the plane that is perpendicular to the up direction.
struct LookLight
{
  double Azimuth;
  double Elevation;
  std::array<double, 3> Color;
};

struct Look
{
  std::string Name;
  std::vector<LookLight> Lights;
  ///@{
  /// Position of the camera, in degrees from the front and above it.
  double CameraAzimuth = 0.0;
  double CameraElevation = 0.0;
  ///@}
};

/// Names of all looks; the first one, "plain", changes nothing.
std::vector<std::string> LookNames();

/// Returns a look; `name` must be one of LookNames().
const Look& FindLook(const std::string& name);

/// Sets the options that the look of `options` has and that are not on the command line. Call after
/// parsing.
void ApplyLook(const CommandLine& app, RenderOptions& options);

}
#endif
