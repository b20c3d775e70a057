// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Homogeneous participating medium in scene coordinates: the coefficients of [Shafts eq. 1].
#ifndef penumbra_Medium_h
#define penumbra_Medium_h

#include <glm/glm.hpp>

#include "vtkPenumbraFiltersRayTracingModule.h" // for export macro, which tests need

#include <limits>

namespace penumbra
{

struct VTKPENUMBRAFILTERSRAYTRACING_EXPORT Medium
{
  enum class Phases
  {
    Isotropic,
    Rayleigh,
    HenyeyGreenstein
  };

  double Scattering = 0.0; ///< scattering coefficient, per unit of length
  double Extinction = 0.0; ///< extinction coefficient: absorption + scattering
  Phases Phase = Phases::Isotropic;
  double Asymmetry = 0.0; ///< mean cosine of HenyeyGreenstein, in (-1, 1)
  /// Corners of the bounding box.
  glm::dvec3 Low{ -std::numeric_limits<double>::infinity() };
  glm::dvec3 High{ std::numeric_limits<double>::infinity() };

  /// Returns the phase function, per steradian, for the cosine of a scattering angle.
  double PhaseFunction(double cosine) const;

  /// Clips the interval [near, far] of a ray to the medium. Returns false if nothing remains.
  bool Clip(glm::dvec3 origin, glm::dvec3 direction, double& near, double& far) const;

  /// Returns the distance from a point in the medium to its boundary along a unit direction;
  /// infinite if the medium is unbounded in this direction.
  double DistanceToExit(glm::dvec3 point, glm::dvec3 direction) const;
};

}
#endif
