// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Coefficients of a homogeneous medium and their defaults, for light shafts by ray casting and in
// OpenGL images.
#ifndef penumbra_MediumCoefficients_h
#define penumbra_MediumCoefficients_h

#include <algorithm>

namespace penumbra
{

/// Optical depth of the diagonal of the scene if the scattering coefficient is negative. A choice:
/// shafts are visible, and 22 % of the light from the far end is lost.
constexpr double DefaultOpticalDepth = 0.25;

/// Coefficients per unit of length [Shafts eq. 1].
struct MediumCoefficients
{
  double Scattering = 0.0;
  double Extinction = 0.0; ///< absorption + scattering
};

/// Returns the coefficients for the settings of vtkPenumbraMedium and vtkPenumbraLightShaftPass.
/// Negative scattering is replaced by DefaultOpticalDepth / `diagonal`, where `diagonal` > 0 is
/// that of the scene, and extinction below scattering by scattering.
inline MediumCoefficients ResolveMediumCoefficients(
  double scattering, double extinction, double diagonal)
{
  const double resolved = scattering >= 0.0 ? scattering : DefaultOpticalDepth / diagonal;
  return { resolved, std::max(extinction, resolved) };
}

}
#endif
