// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The options of the medium of `penumbra render`.
#ifndef penumbra_ShaftOptions_h
#define penumbra_ShaftOptions_h

#include "Parsing/Arguments.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

class vtkRenderer;

namespace penumbra
{

constexpr double Unset = std::numeric_limits<double>::quiet_NaN();

/// Medium of the light shafts. Coefficients are per world unit: none, one, or red, green and blue.
struct ShaftOptions
{
  bool Enabled = false;
  std::vector<double> Scattering; ///< empty: 0.25 / the bounds' diagonal
  std::vector<double> Extinction; ///< empty: as Scattering
  double Rayleigh = 0.0;
  std::string Phase = "isotropic";
  double Asymmetry = 0.0;                 ///< Henyey-Greenstein asymmetry g
  double ScaleHeight = 0.0;               ///< world units; 0: the same density everywhere
  double BaseHeight = Unset;              ///< unset: the lowest point of the bounds
  std::optional<Vector3> Up;              ///< unset: 0,1,0
  std::string Density;                    ///< ray: file of the density image; empty: none
  std::string SurfaceLight = "automatic"; ///< ray: "automatic", "attenuated" or "unattenuated"
  bool BehindTranslucent = false;         ///< ray: translucent surfaces are in front of the medium
  std::string Estimator = "depth";        ///< raster: "depth" or "shadow-map"

  /// Names of the options that have an effect with --light-shafts only.
  static const std::vector<std::string>& GetNames();
};

/// Returns the lowest height of the visible bounds along `up`.
double FindLowestHeight(vtkRenderer* renderer, const Vector3& up);

/// Declares the options on `app`; parsing fills `shafts`, which must outlive `app`.
void DeclareShaftOptions(const CommandLine& app, ShaftOptions& shafts);

/// Throws CommandError if options contradict each other.
void CheckShaftOptions(const ShaftOptions& shafts);

}
#endif
