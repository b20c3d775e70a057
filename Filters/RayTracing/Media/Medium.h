// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A homogeneous medium that absorbs and scatters light: eq. 1 of [Shafts] in the form of its
// coefficients, in scene coordinates.
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

  double Scattering = 0.0; ///< share of light scattered per unit of length
  double Extinction = 0.0; ///< share lost, scattering included
  Phases Phase = Phases::Isotropic;
  double Asymmetry = 0.0; ///< HenyeyGreenstein: mean cosine, -1 to 1
  glm::dvec3 Low{ -std::numeric_limits<double>::infinity() };
  glm::dvec3 High{ std::numeric_limits<double>::infinity() };

  /// The share of scattered light per steradian that turns by the angle of this cosine.
  double PhaseFunction(double cosine) const;

  /// Cuts [near, far] of a ray to what lies in the medium; false: nothing does.
  bool Clip(glm::dvec3 origin, glm::dvec3 direction, double& near, double& far) const;

  /// The way through the medium from a point in it, in a unit direction; infinite where it never ends.
  double DistanceToExit(glm::dvec3 point, glm::dvec3 direction) const;
};

}
#endif
