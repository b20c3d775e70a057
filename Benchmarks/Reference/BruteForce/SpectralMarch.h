// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Single scattering along a ray through any medium by equidistant steps, one wavelength at a time:
// no closed form, no table, no shared code. Shadows are a function.
#ifndef penumbra_SpectralMarch_h
#define penumbra_SpectralMarch_h

#include <glm/glm.hpp>

#include <functional>

namespace penumbra
{

/// A medium at one wavelength, and one light of radiance 1 before attenuation.
struct MarchedMedium
{
  double Scattering = 0.0; ///< with Henyey and Greenstein's phase function of mean cosine Asymmetry
  double Asymmetry = 0.0;
  double Rayleigh = 0.0;
  double Extinction = 0.0;
  std::function<double(glm::dvec3)> Density; ///< relative
  glm::dvec3 Light{ 0.0 };                   ///< position, or unit direction toward the light
  bool IsPositional = false;
  double LightPath = 0.0; ///< directional: length of the marched path toward the light
};

/// Returns the light that the medium scatters along origin + t direction, t in [0, length], toward
/// the origin. `isLit` tells whether a point sees the light. Equal steps on both paths.
double MarchInScattering(const MarchedMedium& medium, glm::dvec3 origin, glm::dvec3 direction,
  double length, const std::function<bool(glm::dvec3)>& isLit, int steps);

/// Returns the transmittance along a segment.
double MarchTransmittance(
  const MarchedMedium& medium, glm::dvec3 origin, glm::dvec3 direction, double length, int steps);

}
#endif
