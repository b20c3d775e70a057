// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Participating medium in scene coordinates: the coefficients of [Shafts eq. 1] for one color
// channel, and the medium of all channels.
#ifndef penumbra_Medium_h
#define penumbra_Medium_h

#include "Lights/LightAttenuation.h"
#include "MediumDensity.h"

#include <glm/glm.hpp>

#include <array>
#include <limits>

namespace penumbra
{

struct Light;

/// One color channel.
struct VTKPENUMBRAFILTERSRAYTRACING_EXPORT Medium
{
  enum class Phases
  {
    Isotropic,
    Rayleigh,
    HenyeyGreenstein
  };

  double Scattering = 0.0; ///< scattering coefficient, per unit of length
  double Rayleigh = 0.0;   ///< scattering coefficient with the Rayleigh phase function
  double Extinction = 0.0; ///< extinction coefficient: absorption + scattering of both kinds
  Phases Phase = Phases::Isotropic; ///< of Scattering
  double Asymmetry = 0.0;           ///< mean cosine of HenyeyGreenstein, in (-1, 1)
  /// Corners of the bounding box.
  glm::dvec3 Low{ -std::numeric_limits<double>::infinity() };
  glm::dvec3 High{ std::numeric_limits<double>::infinity() };
  MediumDensity Density; ///< factor on the coefficients

  /// Returns the phase function of Scattering, per steradian, for the cosine of a scattering angle.
  double PhaseFunction(double cosine) const;

  /// Returns true if the medium scatters light.
  bool Scatters() const { return this->Scattering > 0.0 || this->Rayleigh > 0.0; }

  /// Clips the interval [near, far] of a ray to the medium. Returns false if nothing remains.
  bool Clip(glm::dvec3 origin, glm::dvec3 direction, double& near, double& far) const;

  /// Returns the distance from a point in the medium to its boundary along a unit direction;
  /// infinite if the medium is unbounded in this direction.
  double DistanceToExit(glm::dvec3 point, glm::dvec3 direction) const;

  /// Returns the column between a point in the medium and a light at `distance`. In an unbounded
  /// homogeneous medium, directional lights are specified as they arrive at the point: 0.
  double ColumnToLight(glm::dvec3 point, glm::dvec3 direction, double distance) const;
};

/// Red, green and blue channel. They differ in coefficients only.
struct VTKPENUMBRAFILTERSRAYTRACING_EXPORT SpectralMedium : LightAttenuation
{
  SpectralMedium() = default;
  /// A gray medium.
  SpectralMedium(const Medium& channel)
    : Channels{ channel, channel, channel }
  {
  }

  std::array<Medium, 3> Channels;
  bool AttenuatesSurfaceLight = false;
  bool IncludesTranslucentSurfaces = true; ///< they are seen through the medium

  /// Returns true if all channels have the same coefficients.
  bool IsGray() const;

  glm::vec3 TransmittanceToLight(const Light& light, glm::vec3 point) const override;
};

}
#endif
