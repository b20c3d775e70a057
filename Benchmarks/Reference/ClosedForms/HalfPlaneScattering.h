// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A light shaft with closed-form single scattering: a medium with a flat top under a directional
// light from straight above. A black half-plane, z = 1, shadows x < 0. The camera looks along +x
// from below it.
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

  /// Bounds of the medium: they contain the edge of the half-plane and end above it.
  double Low[3] = { -Endless, -Endless, -Endless };
  double High[3] = { Endless, Endless, 2.0 };
  double Intensity = 1.0; ///< of the directional light

  /// Adds the plane, the camera (view angle 90 degrees) and the directional light, which is
  /// returned.
  vtkLight* AddTo(vtkRenderer* renderer) const;

  void Describe(vtkPenumbraMedium* medium) const;

  /// Radiance that arrives at the camera through the point (`right`, `up`) of the plane at distance
  /// 1.
  double Exact(double right, double up) const;
};

}
#endif
