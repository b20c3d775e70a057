// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Light shafts whose single scattering is known: a medium with a flat top under a sun straight above;
// a black half-plane, z = 1, keeps the light off x < 0. The eye looks along +x from below it.
#ifndef penumbra_HalfPlaneScattering_h
#define penumbra_HalfPlaneScattering_h

#include "vtkNew.h"

#include <limits>

class vtkLight;
class vtkPenumbraMedium;
class vtkRenderer;

namespace penumbra
{

class HalfPlaneInHaze
{
public:
  static constexpr double Endless = std::numeric_limits<double>::infinity();
  static constexpr double Eye[3] = { -1.3, 0.0, -0.5 };
  static constexpr double Scattering = 0.3;
  static constexpr double Extinction = 0.5;

  /// The box that the medium fills; it holds the edge of the half-plane and ends above it.
  double Low[3] = { -Endless, -Endless, -Endless };
  double High[3] = { Endless, Endless, 2.0 };
  double Intensity = 1.0; ///< of the sun

  /// Adds plane and camera, with a view angle of 90 degrees, and the sun, which it returns.
  vtkLight* AddTo(vtkRenderer* renderer) const;

  void Describe(vtkPenumbraMedium* medium) const;

  /// What reaches the eye through the point (`right`, `up`) of the plane at distance 1.
  double Exact(double right, double up) const;
};

}
#endif
